// The table of markers and what can be done to them.
import { useEffect, useRef } from 'preact/hooks'
import { app } from '../app'
import { find, isComplete } from '../edits'
import * as placing from '../placing'
import type { Marker } from '../types'
import { Button, chooseFiles, Field, figure, Section } from './parts'
import { exportMarkers, importMarkers, markerFormats } from './import'
import { markerEndings } from '../files'

function Status({ marker }: { marker: Marker }) {
  if (isComplete(marker)) return <span class="status both" title="set on both models">both</span>
  const missing = marker.source ? 'target' : 'source'
  return <span class="status half" title={`not yet on the ${missing}`}>{`no ${missing}`}</span>
}

function Row({ marker, number }: { marker: Marker; number: number }) {
  const row = useRef<HTMLTableRowElement>(null)
  const chosen = app.selected === marker.id
  const error = app.stale ? undefined : app.state?.fit?.marker_errors[marker.id]
  useEffect(() => {
    if (chosen) row.current?.scrollIntoView({ block: 'nearest' })
  }, [chosen])
  return (
    <tr ref={row} class={chosen ? 'chosen' : ''} aria-selected={chosen} data-marker={marker.id} onClick={() => placing.select(marker.id)} onDblClick={() => placing.flyToMarker(marker.id)}>
      <td class="number">{number}</td>
      <td class="name">
        <Field
          aria-label={`name of marker ${number}`}
          value={marker.name}
          maxLength={60}
          disabled={app.readOnly}
          onFocus={() => app.selected !== marker.id && placing.select(marker.id)}
          commit={(name) => placing.rename(marker, name)}
        />
      </td>
      <td>
        <Status marker={marker} />
      </td>
      <td class={`error${error !== undefined && error > 0.5 ? ' warn' : ''}`} title="distance after the fit, percent of the target's size">
        {error === undefined ? '' : figure(error)}
      </td>
      <td>
        <button
          type="button"
          class="lock"
          aria-pressed={marker.locked}
          aria-label={`lock ${marker.name}`}
          title={marker.locked ? 'Locked: it cannot be moved or deleted' : 'Lock it where it is'}
          onClick={(e) => {
            e.stopPropagation()
            placing.change(marker, `${marker.locked ? 'unlock' : 'lock'} ${marker.name}`, { locked: !marker.locked })
          }}
        >
          <svg viewBox="0 0 16 16" width="14" height="14" aria-hidden="true">
            <path d={marker.locked ? 'M5 7V5a3 3 0 0 1 6 0v2' : 'M5 7V5a3 3 0 0 1 5.8-1'} fill="none" stroke="currentColor" stroke-width="1.7" />
            <rect x="3" y="7" width="10" height="7" rx="1.5" fill="currentColor" />
          </svg>
        </button>
      </td>
    </tr>
  )
}

function Symmetry() {
  const { symmetry } = app.store.document
  const set = (change: Partial<typeof symmetry>) =>
    app.store.edit('change the symmetry', (d) => ({ ...d, symmetry: { ...d.symmetry, ...change } }), 'symmetry')
  return (
    <details open={symmetry.on}>
      <summary>Symmetry</summary>
      <label class="check">
        <input type="checkbox" checked={symmetry.on} disabled={app.readOnly} onChange={(e) => set({ on: e.currentTarget.checked })} />
        A new marker gets its mirror twin on both models
      </label>
      {symmetry.on && (
        <>
          <label class="inline">
            Plane across
            <select value={symmetry.axis} onChange={(e) => set({ axis: Number(e.currentTarget.value) })}>
              <option value={0}>x (left and right)</option>
              <option value={1}>y (up and down)</option>
              <option value={2}>z (front and back)</option>
            </select>
          </label>
          {(['source', 'target'] as const).map((side) => (
            <label class="inline" key={side}>
              Shift on the {side}
              <input type="range" min={-0.2} max={0.2} step={0.002} value={symmetry[side]} onInput={(e) => set({ [side]: e.currentTarget.valueAsNumber })} />
            </label>
          ))}
        </>
      )}
    </details>
  )
}

export function MarkersPanel() {
  const { markers } = app.store.document
  const complete = markers.filter(isComplete).length
  const chosen = find(app.store.document, app.selected)
  const ready = app.info('source') && app.info('target')
  return (
    <>
      <Section title="Markers" aside={`${complete} of ${markers.length} on both`}>
        {markers.length === 0 ? (
          <p class="hint">
            Click a place on the source, then the same place on the target: nose, chin, corners of the eyes. 30 to 50
            serve well; with fewer than three the fit has to guess how the models lie.
          </p>
        ) : (
          <div class="table">
            <table>
              <thead>
                <tr>
                  <th>#</th>
                  <th>Name</th>
                  <th>On</th>
                  <th title="Distance after the fit, percent of the target's size">Err. %</th>
                  <th />
                </tr>
              </thead>
              <tbody>
                {markers.map((marker, i) => (
                  <Row marker={marker} number={i + 1} key={marker.id} />
                ))}
              </tbody>
            </table>
          </div>
        )}
        {placing.ghosts.why && <p class="ghost">{placing.ghosts.why}</p>}
        <div class="row">
          <Button small title="Show it" keys="F" disabled={!chosen} onClick={() => placing.flyToMarker(chosen!.id)}>
            Show
          </Button>
          <Button small title="Up in the list" keys="Alt+↑" disabled={!chosen || app.readOnly} onClick={() => placing.reorder(chosen!, -1)} label="move up">
            ↑
          </Button>
          <Button small title="Down in the list" keys="Alt+↓" disabled={!chosen || app.readOnly} onClick={() => placing.reorder(chosen!, 1)} label="move down">
            ↓
          </Button>
          <Button small title="Delete it" keys="Delete" disabled={!chosen || chosen.locked || app.readOnly} onClick={placing.removeSelected}>
            Delete
          </Button>
          <Button small title="Where the next marker helps most" keys="N" disabled={!ready} onClick={() => void placing.suggestNext()}>
            Suggest next
          </Button>
        </div>
      </Section>
      <label class="check">
        <input type="checkbox" checked={app.snap} onChange={(e) => app.set({ snap: e.currentTarget.checked })} />
        Snap to the nearest vertex
      </label>
      <Symmetry />
      <Section title="Files">
        <div class="row">
          <Button small disabled={!ready || app.readOnly} title="One file for both sides, one a side, or one side alone" onClick={() => chooseFiles(markerEndings.join(','), true, (files) => void importMarkers(files))}>
            Import…
          </Button>
          <select
            aria-label="Export markers as"
            value=""
            disabled={markers.length === 0}
            onChange={(e) => {
              const format = e.currentTarget.value
              e.currentTarget.value = ''
              if (format) void exportMarkers(format)
            }}
          >
            <option value="">Export…</option>
            {markerFormats.map(([format, name]) => (
              <option value={format} key={format}>
                {name}
              </option>
            ))}
          </select>
        </div>
      </Section>
      <Button primary={complete >= 3} disabled={!ready} onClick={() => app.set({ step: 'fit' })}>
        Go on to the fit
      </Button>
    </>
  )
}
