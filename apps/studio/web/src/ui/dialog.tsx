// A question over the page, with its answers as buttons.
import { useEffect, useRef } from 'preact/hooks'
import { app } from '../app'

// Tab stays within an open dialogue.
export function keepFocus(event: KeyboardEvent) {
  if (event.key !== 'Tab') return
  const all = [...(event.currentTarget as Element).querySelectorAll<HTMLElement>('button:not(:disabled), a[href], input')]
  const [first, last] = [all[0], all.at(-1)]
  if (!first || !last) return
  const out = event.shiftKey ? first : last
  if (document.activeElement !== out) return
  event.preventDefault()
  ;(event.shiftKey ? last : first).focus()
}

export function Dialog() {
  const { question } = app
  const box = useRef<HTMLDivElement>(null)
  useEffect(() => {
    if (!question) return
    const before = document.activeElement as HTMLElement | null
    box.current?.querySelector<HTMLElement>('button.primary, button')?.focus()
    return () => before?.focus?.()
  }, [question])
  if (!question) return null
  const { title, lines, choices, answer } = question
  return (
    <div class="sheet" onClick={() => answer(null)}>
      <div ref={box} role="dialog" aria-modal="true" aria-label={title} class="dialog question" onClick={(e) => e.stopPropagation()} onKeyDown={keepFocus}>
        <h2>{title}</h2>
        {lines.map((line) => (
          <p key={line}>{line}</p>
        ))}
        <footer>
          <button type="button" onClick={() => answer(null)}>
            Cancel
          </button>
          {choices.map((choice) => (
            <button type="button" key={choice.answer} class={choice.primary ? 'primary' : ''} onClick={() => answer(choice.answer)}>
              {choice.label}
              {choice.aside && <small>{choice.aside}</small>}
            </button>
          ))}
        </footer>
      </div>
    </div>
  )
}
