// The page: bar, views, panel, and what lies over them.
import { api } from '../api'
import { app, type Step } from '../app'
import { commands } from '../keys'
import type { Side } from '../types'
import { redo, undo } from '../placing'
import { refreshLook, showFitted } from '../work'
import { ExportPanel } from './export'
import { FitPanel } from './fit'
import { MarkersPanel } from './markers'
import { MorphPanel } from './morph'
import { dropped } from '../files'
import { readAgain } from '../projects'
import { Dialog, keepFocus } from './dialog'
import { OpenPanel, take } from './open'
import { Button, useApp } from './parts'
import { ToldNotes } from './told'
import { Views } from './views'

const steps: [Step, string, () => preact.JSX.Element][] = [
  ['open', 'Models', OpenPanel],
  ['markers', 'Markers', MarkersPanel],
  ['fit', 'Fit', FitPanel],
  ['morph', 'Morph', MorphPanel],
  ['export', 'Export', ExportPanel],
]

export function goTo(step: Step) {
  app.set({ step })
  if (step === 'morph' || step === 'export') app.shown.add('result')
  if (step === 'fit') void app.attempt(showFitted)
  refreshLook()
}

function toggleTheme() {
  const root = document.documentElement
  const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches
  root.dataset.theme = dark ? 'light' : 'dark'
  localStorage.setItem('meshtween-theme', root.dataset.theme)
  refreshLook()
}

function Bar() {
  const { saver, store } = app
  return (
    <header class="bar">
      <h1>
        mesh<b>tween</b>
      </h1>
      <nav aria-label="Steps">
        {steps.map(([step, name], i) => (
          <button type="button" key={step} aria-current={app.step === step ? 'step' : undefined} title={`${name} (Alt+${i + 1})`} onClick={() => goTo(step)}>
            <i>{i + 1}</i>
            {name}
          </button>
        ))}
      </nav>
      <span class="gap" />
      <span class={`saved ${saver.state}`} role="status" title={saver.problem || app.state?.project.file}>
        {saver.state === 'saved' ? 'Saved' : saver.state === 'saving' ? 'Saving…' : 'Not saved'}
      </span>
      <Button small onClick={undo} disabled={!store.undoLabel || app.readOnly} title={store.undoLabel ? `Undo: ${store.undoLabel}` : 'Nothing to undo'} keys="Ctrl+Z" label="undo">
        ↶
      </Button>
      <Button small onClick={redo} disabled={!store.redoLabel || app.readOnly} title={store.redoLabel ? `Redo: ${store.redoLabel}` : 'Nothing to redo'} keys="Ctrl+Shift+Z" label="redo">
        ↷
      </Button>
      <Button small onClick={toggleTheme} title="Light or dark" label="light or dark">
        ◐
      </Button>
      <Button small onClick={() => app.set({ helpOpen: true })} title="Keys and mouse" keys="?" label="help">
        ?
      </Button>
    </header>
  )
}

function Help() {
  if (!app.helpOpen) return null
  const groups = [...new Set(commands.map((command) => command.group))]
  return (
    <div class="sheet" onClick={() => app.set({ helpOpen: false })}>
      <div role="dialog" aria-modal="true" aria-label="Help" class="dialog" onClick={(e) => e.stopPropagation()} onKeyDown={keepFocus}>
        <header>
          <h2>Keys and mouse</h2>
          <button type="button" class="small" ref={(button) => button?.focus()} onClick={() => app.set({ helpOpen: false })}>
            Close
          </button>
        </header>
        <div class="columns">
          <section>
            <h3>Mouse</h3>
            <dl>
              <dt>Click</dt>
              <dd>place a marker, or select one</dd>
              <dt>Drag</dt>
              <dd>turn; the middle button too. On the selected marker: move it along the surface</dd>
              <dt>Shift+drag</dt>
              <dd>pan; the right button too</dd>
              <dt>Wheel</dt>
              <dd>zoom</dd>
              <dt>Arrows, + −</dt>
              <dd>turn and zoom the focused view; Shift+arrows pan</dd>
              <dt>Tab</dt>
              <dd>next view or control</dd>
            </dl>
          </section>
          {groups.map((group) => (
            <section key={group}>
              <h3>{group}</h3>
              <dl>
                {commands
                  .filter((command) => command.group === group)
                  .map((command) => [
                    <dt>{command.keys.length > 2 ? `${command.keys[0]} … ${command.keys.at(-1)!.slice(-1)}` : command.keys.map((key) => <kbd key={key}>{key.replace('ArrowUp', '↑').replace('ArrowDown', '↓')}</kbd>)}</dt>,
                    <dd>{command.what}</dd>,
                  ])}
              </dl>
            </section>
          ))}
        </div>
      </div>
    </div>
  )
}

function Banners() {
  return (
    <div class="banners">
      {app.lost && <p role="alert">The studio program does not answer. Start it again and open the address that it prints: everything up to your last change is saved.</p>}
      {app.readOnly && (
        <p role="alert">
          This project is open in another tab, which edits it. Here you can only look.
          <Button small onClick={() => void app.attempt(() => api.takeOver().then(() => app.refresh(true)))}>
            Edit here instead
          </Button>
        </p>
      )}
      {(['source', 'target'] as const).map(
        (side) =>
          app.outside[side] && (
            <p role="alert" key={side}>
              {app.info(side)?.name} has changed on disk.
              <Button small disabled={app.readOnly || app.running} onClick={() => void readAgain(side)}>
                Read it again
              </Button>
            </p>
          ),
      )}
    </div>
  )
}

// What the page waits for, how far it is, and how to stop it.
function BusyBox() {
  const { busy } = app
  if (!busy) return null
  return (
    <div class="busy" role="status">
      <span>{busy.text}…</span>
      {busy.stop && <progress max={1} value={busy.part} aria-label={busy.text} />}
      {busy.stop && (
        <Button small onClick={busy.stop} label="stop">
          Cancel
        </Button>
      )}
    </div>
  )
}

export function Page() {
  useApp()
  const Panel = steps.find(([step]) => step === app.step)![2]
  return (
    <div
      class="page"
      onDragOver={(e) => e.preventDefault()}
      onDrop={(e) => {
        e.preventDefault()
        const card = e.target instanceof Element ? e.target.closest<HTMLElement>('[data-side]') : null
        void take(dropped(e), card?.dataset.side as Side | undefined)
      }}
    >
      <Bar />
      <Banners />
      <Views />
      <aside class="panel" aria-label={steps.find(([step]) => step === app.step)![1]}>
        <ToldNotes />
        <Panel />
      </aside>
      <div class="toasts" role="status" aria-live="polite">
        {app.toasts.map((toast) => (
          <p class={toast.bad ? 'bad' : ''} key={toast.id}>
            {toast.text}
          </p>
        ))}
      </div>
      <BusyBox />
      <Dialog />
      <Help />
    </div>
  )
}
