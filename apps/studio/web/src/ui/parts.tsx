// Small parts that all panels use.
import type { ComponentChildren, JSX } from 'preact'
import { useEffect, useReducer, useState } from 'preact/hooks'
import { app } from '../app'
import { setOption } from '../edits'
import type { OptionRow } from '../types'

// Draws the component anew whenever the state or the document changes.
export function useApp() {
  const [, again] = useReducer((count: number) => count + 1, 0)
  useEffect(() => {
    const stop = app.subscribe(() => again(undefined as never))
    return () => void stop()
  }, [])
  return app
}

interface ButtonProps {
  onClick: () => void
  children: ComponentChildren
  title?: string
  keys?: string
  primary?: boolean
  pressed?: boolean
  disabled?: boolean
  small?: boolean
  label?: string
}

export function Button({ onClick, children, title, keys, primary, pressed, disabled, small, label }: ButtonProps) {
  const kind = [primary && 'primary', small && 'small', pressed && 'pressed'].filter(Boolean).join(' ')
  return (
    <button
      type="button"
      class={kind || undefined}
      title={keys ? `${title ?? ''} (${keys})` : title}
      aria-label={label}
      aria-pressed={pressed === undefined ? undefined : pressed}
      disabled={disabled}
      onClick={onClick}
    >
      {children}
    </button>
  )
}

export const Section = ({ title, children, aside }: { title: string; children: ComponentChildren; aside?: ComponentChildren }) => (
  <section>
    <h2>
      {title}
      {aside && <span class="aside">{aside}</span>}
    </h2>
    {children}
  </section>
)

// A row of choices of which one holds.
export function Choice<T extends string>(props: { label: string; value: T; of: [T, string][]; onChange: (value: T) => void }) {
  return (
    <div class="choice" role="group" aria-label={props.label}>
      {props.of.map(([value, text]) => (
        <button type="button" aria-pressed={value === props.value} onClick={() => props.onChange(value)} key={value}>
          {text}
        </button>
      ))}
    </div>
  )
}

// A field whose text is the person's own until it is committed: the page may draw itself anew meanwhile.
export function Field({ value, commit, ...rest }: { value: string | number; commit: (text: string) => void } & Omit<JSX.InputHTMLAttributes<HTMLInputElement>, 'value'>) {
  const [draft, setDraft] = useState<string | null>(null)
  return (
    <input
      {...rest}
      value={draft ?? value}
      onInput={(e) => setDraft(e.currentTarget.value)}
      onKeyDown={(e) => e.key === 'Enter' && e.currentTarget.blur()}
      onBlur={(e) => {
        if (e.currentTarget.value !== String(value)) commit(e.currentTarget.value)
        setDraft(null)
      }}
    />
  )
}

// Options as the program describes them, each with its one line of explanation.
export function OptionForm({ of, rows }: { of: 'fit' | 'morph'; rows: OptionRow[] }) {
  const { store } = app
  const valueOf = (row: OptionRow) => store.document.options[of][row.name] ?? row.default
  const all = app.state?.schema[of] ?? []
  const matters = ({ when }: OptionRow) => !when || all.some((row) => row.name === when[0] && valueOf(row) === when[1])
  return (
    <div class="options">
      {rows.filter(matters).map((row) => {
        const value = valueOf(row)
        const set = (next: number | string) => store.edit(`set ${row.label}`, (d) => setOption(d, of, row.name, next))
        return (
          <label key={row.name} class="option">
            <span class="name">{row.label}</span>
            {row.type === 'choice' ? (
              <select value={value} disabled={app.readOnly} onChange={(e) => set(e.currentTarget.value)}>
                {row.choices!.map((choice) => (
                  <option value={choice} key={choice}>
                    {choice}
                  </option>
                ))}
              </select>
            ) : (
              <Field
                type="number"
                step="any"
                min={row.min}
                max={row.max}
                value={value}
                disabled={app.readOnly}
                commit={(text) => {
                  const next = text === '' ? NaN : Number(text)
                  if (next >= row.min! && next <= row.max!) set(next)
                  else app.toast(`${row.label} must lie between ${row.min} and ${row.max}.`, true)
                }}
              />
            )}
            <small>{row.help}</small>
          </label>
        )
      })}
    </div>
  )
}

export function JobBar({ kind }: { kind: string }) {
  const { job } = app
  const [, tick] = useReducer((count: number) => count + 1, 0)
  useEffect(() => {
    const timer = setInterval(() => tick(undefined as never), 1000)
    return () => clearInterval(timer)
  }, [])
  if (!app.running || job.kind !== kind) return null
  const seconds = Math.floor((performance.now() - app.jobBegan) / 1000)
  return (
    <div class="job" role="status">
      <progress max={1} value={job.fraction ?? 0} aria-label={job.stage} />
      <span>
        {job.stage}
        {seconds >= 3 && <small> · {seconds} s</small>}
      </span>
      <b>{Math.round(100 * (job.fraction ?? 0))} %</b>
    </div>
  )
}

// Three significant digits, as people write them.
export function figure(value: number): string {
  if (value === 0) return '0'
  if (Math.abs(value) < 1e-4) return '<0.0001'
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value))))
  return value.toFixed(Math.min(5, digits))
}

// Bytes, as people write them.
export const size = (bytes: number) =>
  bytes >= 1 << 30 ? `${figure(bytes / (1 << 30))} GB` : bytes >= 1 << 20 ? `${figure(bytes / (1 << 20))} MB` : `${Math.ceil(bytes / 1024)} kB`

export const count = (value: number) => value.toLocaleString('en-GB').replace(/,/g, ' ')

// Asks for files with the system's own dialogue.
export function chooseFiles(accept: string, multiple: boolean, then: (files: File[]) => void) {
  const input = document.createElement('input')
  input.type = 'file'
  input.accept = accept
  input.multiple = multiple
  input.onchange = () => input.files?.length && then([...input.files])
  input.click()
}
