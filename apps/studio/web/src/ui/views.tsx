// The views on the canvas, each with its name and what it shows.
import { useEffect, useRef } from 'preact/hooks'
import { app, type PaneName } from '../app'
import { showPins } from '../pins'
import { paths, refreshLook } from '../work'
import { dropped } from '../files'
import { take } from './open'
import { HeatLegend } from './fit'
import { Timeline } from './morph'
import { Button, Choice } from './parts'
import type { Shading } from '../scene/model'
import { Vector3 } from 'three'

const names: Record<PaneName, string> = { source: 'Source', target: 'Target', result: 'Result', compare: 'Compared' }

function caption(name: PaneName): string {
  if (name === 'result') return paths.main ? String(app.store.document.options.morph.method ?? app.state?.schema.morph[0]?.default) : app.result ? (app.running ? 'fitting' : app.stale ? 'fitted before the markers changed' : 'fitted') : ''
  if (name === 'compare') return paths.compareMethod
  return app.info(name)?.name ?? ''
}

function View({ name }: { name: PaneName }) {
  const element = useRef<HTMLDivElement>(null)
  useEffect(() => {
    app.pane(name).attach(element.current)
    app.stage.observe(element.current!)
    return () => app.pane(name).attach(null)
  }, [name])
  const empty = name === 'source' || name === 'target' ? !app.info(name) : !app.pane(name).model
  const side = name === 'source' || name === 'target' ? name : undefined
  return (
    <div
      ref={element}
      class={`view ${name}`}
      tabIndex={0}
      role="application"
      aria-label={`${names[name]} view: arrows turn, plus and minus zoom${side ? ', Insert places a marker in the middle' : ''}`}
      data-view={name}
      onDragOver={(e) => e.preventDefault()}
      onDrop={(e) => {
        e.preventDefault()
        e.stopPropagation()
        void take(dropped(e), side)
      }}
    >
      <header>
        {side && <i class={`dot ${side}`} />}
        <b>{names[name]}</b> <span>{caption(name)}</span>
      </header>
      {empty && (
        <p class="empty">
          {side ? `Drop a model here for the ${side}.` : 'The result appears here after the fit.'}
        </p>
      )}
      {side && app.step === 'markers' && <i class="crosshair" aria-hidden="true" />}
      {name === 'result' && app.result && !paths.main && !app.running && <HeatLegend />}
    </div>
  )
}

function Tools() {
  return (
    <div class="tools" role="toolbar" aria-label="View">
      <Choice
        label="Shading"
        value={app.shading}
        of={[
          ['smooth', 'Smooth'],
          ['flat', 'Flat'],
          ...((app.info('source')?.uvs || app.info('target')?.uvs ? [['uv', 'UV']] : []) as [Shading, string][]),
          ...((app.info('source')?.colors || app.info('target')?.colors ? [['colour', 'Colour']] : []) as [Shading, string][]),
        ]}
        onChange={(shading) => {
          app.set({ shading })
          refreshLook()
        }}
      />
      <Button
        small
        pressed={app.wires}
        title="Show the mesh's edges"
        keys="W"
        onClick={toggleWires}
      >
        Wires
      </Button>
      <Button small pressed={app.linked} title="Turn all views alike" keys="L" onClick={toggleLinked}>
        Match view
      </Button>
      <Button small title="Show the whole models from the front" keys="Home" onClick={frameAll}>
        Frame
      </Button>
      <span class="gap" />
      {(['source', 'target', 'result'] as PaneName[]).map((name, i) => (
        <Button
          small
          key={name}
          pressed={app.shown.has(name)}
          title={`Show or hide the ${name}`}
          keys={String(i + 1)}
          onClick={() => togglePane(name)}
        >
          {names[name]}
        </Button>
      ))}
    </div>
  )
}

export function toggleWires() {
  app.set({ wires: !app.wires })
  refreshLook()
}

export function toggleLinked() {
  app.set({ linked: !app.linked })
  app.stage.link(app.linked, app.pane('source'))
}

export function togglePane(name: PaneName) {
  if (!app.shown.delete(name)) app.shown.add(name)
  if (app.shown.size === 0) app.shown.add(name)
  app.changed()
  app.stage.draw()
}

export function frameAll() {
  for (const pane of app.stage.panes.values()) pane.flyTo(new Vector3(), 2.1, new Vector3(0.34, 0.15, 0.93))
}

export function Views() {
  const host = useRef<HTMLDivElement>(null)
  useEffect(() => {
    app.stage.attach(host.current)
    return () => app.stage.attach(null)
  }, [])
  showPins()
  const compares = app.step === 'morph' || app.step === 'export'
  const visible = (['source', 'target', 'result', 'compare'] as PaneName[]).filter((name) => app.shown.has(name) && (name !== 'compare' || compares))
  useEffect(() => app.stage.draw(), [visible.join()])
  return (
    <main>
      <Tools />
      <div class={`views ${app.step}`} ref={host}>
        {visible.map((name) => (
          <View name={name} key={name} />
        ))}
      </div>
      {paths.main && <Timeline />}
    </main>
  )
}
