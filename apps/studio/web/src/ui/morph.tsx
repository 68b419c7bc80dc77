// The morph: its method, a second one beside it, and the timeline under the views.
import { useEffect, useRef } from 'preact/hooks'
import { api } from '../api'
import { app } from '../app'
import * as painting from '../painting'
import { heatGradient } from '../scene/heat'
import { onTick, paths, play, player, seek, startMorph, stopComparing, type Player } from '../work'
import { Button, figure, JobBar, OptionForm, Section, useApp } from './parts'

const places = (count: number) => (count === 1 ? 'one place' : `${count} places`)

export function MorphPanel() {
  const rows = app.state?.schema.morph ?? []
  const methods = rows.find((row) => row.name === 'method')?.choices ?? []
  const now = String(app.store.document.options.morph.method ?? rows.find((row) => row.name === 'method')?.default ?? '')
  const running = app.running && app.job.kind === 'morph'
  if (!app.state?.fit)
    return (
      <Section title="Morph">
        <p class="hint">There is no fit yet: place markers and fit first.</p>
        <Button onClick={() => app.set({ step: 'fit' })}>To the fit</Button>
      </Section>
    )
  return (
    <>
      <Section title="Morph">
        <p class="hint">Every shape from the source to the fitted mesh.</p>
        <OptionForm of="morph" rows={rows.filter((row) => row.name === 'method')} />
        <details>
          <summary>More options</summary>
          <OptionForm of="morph" rows={rows.filter((row) => row.name !== 'method')} />
        </details>
        <Timing />
        {running ? (
          <>
            <JobBar kind="morph" />
            <Button onClick={() => void app.attempt(() => api.cancel())} keys="Escape">
              Cancel
            </Button>
          </>
        ) : (
          <Button primary={!paths.main} disabled={app.running || app.readOnly} onClick={() => void startMorph()}>
            {paths.main ? 'Morph again' : 'Morph'}
          </Button>
        )}
        {paths.main && (
          <small>
            Played from {paths.main.meshes} meshes, {figure(100 * paths.main.deviation)} % off the path at most; exports take as many as 0.01 % needs.
            {paths.main.bent > 0 && ` Bent in ${places(paths.main.bent)} where it would cut itself.`}
          </small>
        )}
        {paths.main && paths.main.cuts_left > 0 && <small class="warn">It cuts itself in {places(paths.main.cuts_left)} on the way.</small>}
      </Section>
      {paths.main && (
        <Section title="Side by side">
          <label class="inline">
            Compare with
            <select
              value={paths.compareMethod}
              disabled={app.running}
              onChange={(e) => {
                paths.compareMethod = e.currentTarget.value
                if (paths.compareMethod) void startMorph(true)
                else stopComparing()
              }}
            >
              <option value="">nothing</option>
              {methods
                .filter((method) => method !== now)
                .map((method) => (
                  <option value={method} key={method}>
                    {method}
                  </option>
                ))}
            </select>
          </label>
        </Section>
      )}
      {paths.main && (
        <Button primary onClick={() => app.set({ step: 'export' })}>
          Go on to the export
        </Button>
      )}
    </>
  )
}

// When each part moves: a brush for the source.
function Timing() {
  const { brush } = app
  const { dabs } = app.store.document.timing
  const number = (label: string, value: number, least: number, most: number, set: (value: number) => void) => (
    <label class="inline">
      {label}
      <input
        type="range"
        min={least}
        max={most}
        step={0.01}
        value={value}
        onInput={(e) => set(e.currentTarget.valueAsNumber)}
      />
      <output>{value.toFixed(2)}</output>
    </label>
  )
  return (
    <details class="timing">
      <summary>Timing by region{dabs.length > 0 ? ' (painted)' : ''}</summary>
      <p class="hint">
        Paint on the source what is to move in a part of the time only; what is not painted moves all the time. Then morph again.
      </p>
      {number('Starts at', brush.start, 0, 0.95, (start) => painting.change({ start, end: Math.max(brush.end, start + 0.05) }))}
      {number('Ends at', brush.end, 0.05, 1, (end) => painting.change({ end, start: Math.min(brush.start, end - 0.05) }))}
      {number('Brush', brush.radius, 0.01, 0.3, (radius) => painting.change({ radius }))}
      <div class="row">
        <Button small pressed={brush.on} disabled={app.readOnly} onClick={() => painting.change({ on: !brush.on })} keys="B">
          Paint
        </Button>
        <Button small disabled={dabs.length === 0 || app.readOnly} onClick={painting.clear}>
          Clear
        </Button>
      </div>
      {brush.on && (
        <div class="legend">
          <span>0</span>
          <i style={{ background: heatGradient }} />
          <span>1</span>
          <em>starts at</em>
        </div>
      )}
    </details>
  )
}

export function Timeline() {
  useApp()
  const slider = useRef<HTMLInputElement>(null)
  const output = useRef<HTMLOutputElement>(null)
  // The slider follows without drawing the page anew.
  useEffect(() => {
    const stop = onTick((u) => {
      if (slider.current) slider.current.value = String(u)
      if (output.current) output.current.value = u.toFixed(2)
    })
    return () => void stop()
  }, [])
  const set = (values: Partial<Player>) => {
    Object.assign(player, values)
    seek(player.u)
    app.changed()
  }
  return (
    <div class="timeline" role="group" aria-label="Timeline">
      <Button primary onClick={() => play(!player.playing)} title="Play or pause" keys="Space" label={player.playing ? 'pause' : 'play'}>
        {player.playing ? '❚❚' : '▶'}
      </Button>
      <span>source</span>
      <input
        ref={slider}
        type="range"
        min={0}
        max={1}
        step={0.001}
        defaultValue={String(player.u)}
        aria-label="Place between source (0) and target (1)"
        onInput={(e) => {
          play(false)
          seek(e.currentTarget.valueAsNumber)
        }}
      />
      <span>target</span>
      <output ref={output}>{player.u.toFixed(2)}</output>
      <select aria-label="Speed" value={player.speed} onChange={(e) => set({ speed: Number(e.currentTarget.value) })}>
        {[0.125, 0.25, 0.5, 1, 2].map((speed) => (
          <option value={speed} key={speed}>
            {speed * 2}×
          </option>
        ))}
      </select>
      <select aria-label="At the end" value={player.mode} onChange={(e) => set({ mode: e.currentTarget.value as Player['mode'], direction: 1 })}>
        <option value="ping-pong">to and fro</option>
        <option value="loop">loop</option>
        <option value="once">once</option>
      </select>
      <label class="check">
        <input type="checkbox" checked={player.ease} onChange={(e) => set({ ease: e.currentTarget.checked })} /> ease
      </label>
    </div>
  )
}
