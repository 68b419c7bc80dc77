// The fit: options, progress, and what there is to see of its result.
import { useEffect, useState } from 'preact/hooks'
import { api } from '../api'
import { app } from '../app'
import { heatGradient } from '../scene/heat'
import { chooseHeat, flyInResult, startFit } from '../work'
import { isComplete, placesOf } from '../edits'
import type { FitSummary, Vec3 } from '../types'
import { Button, Choice, figure, JobBar, OptionForm, Section } from './parts'
import { Linked } from './told'

const Figure = ({ name, value, title, bad }: { name: string; value: string; title: string; bad?: boolean }) => (
  <div class={`figure${bad ? ' warn' : ''}`} title={title}>
    <b>{value}</b>
    <span>{name}</span>
  </div>
)

function Places({ title, list }: { title: string; list: { text: string; at: Vec3 }[] }) {
  if (list.length === 0) return null
  return (
    <details>
      <summary>
        {title} <small>click one to see it</small>
      </summary>
      <div class="places">
        {list.map(({ text, at }) => (
          <button type="button" class="small" key={text} onClick={() => flyInResult(at)}>
            {text}
          </button>
        ))}
      </div>
    </details>
  )
}

export function HeatLegend() {
  if (app.heat === 'none') return null
  const [from, to, unit, name] = {
    distance: ['0', figure(app.heatMost), ' %', 'distance to the target'],
    stretch: ['1', figure(app.heatMost), '', 'stretch'],
    trust: ['1', '0', '', 'trust: is there something on the target that answers to it'],
  }[app.heat]
  return (
    <div class="legend">
      <span>{from}</span>
      <i style={{ background: heatGradient }} />
      <span>
        {to}
        {unit}
      </span>
      <em>{name}</em>
    </div>
  )
}

// The lists hold the first of what there is.
const counted = (all: number, listed: number, what: string) => (all > listed ? `${all} ${what}, the first ${listed}` : `${listed} ${what}`)

function worstText({ vertex, fault, value }: FitSummary['worst'][number]) {
  const size = { 'facing away': '', stretched: ` ${figure(value)} times` }[fault] ?? ` ${figure(value)} %`
  return `vertex ${vertex}: ${fault}${size}`
}

function Outcome({ fit }: { fit: FitSummary }) {
  const { quality, guards } = fit
  return (
    <Section title="Outcome" aside={app.stale ? 'markers have changed since' : undefined}>
      <div class="figures">
        <Figure name="to the target" value={`${figure(quality.fitted_to_target.mean)} %`} title="Mean distance from the fitted surface to the target, percent of its size" />
        <Figure name="and back" value={`${figure(quality.target_to_fitted.mean)} %`} title="Mean distance from the target to the fitted surface: what is not covered" />
        <Figure name="flipped" value={String(guards.flips_left)} title="Faces that look the wrong way" bad={guards.flips_left > 0} />
        <Figure name="cuts" value={String(quality.self_intersections)} title={`Pairs of faces that cut each other; the source has ${quality.self_intersections_source}, the target ${quality.self_intersections_target}`} bad={quality.self_intersections > quality.self_intersections_source + quality.self_intersections_target} />
      </div>
      <Choice
        label="Heat map"
        value={app.heat}
        of={[
          ['distance', 'Distance'],
          ['stretch', 'Stretch'],
          ['trust', 'Trust'],
          ['none', 'Plain'],
        ]}
        onChange={chooseHeat}
      />
      <Places title={counted(guards.flips_left, guards.flipped.length, 'flipped faces')} list={guards.flipped.map((flip) => ({ text: `face ${flip.triangle}`, at: flip.at }))} />
      <Places title={counted(quality.self_intersections, guards.cuts.length, 'cuts')} list={guards.cuts.map((cut) => ({ text: cut.triangles.join(' × '), at: cut.at }))} />
      <Places title="Worst places" list={fit.worst.map((place) => ({ text: worstText(place), at: place.fitted }))} />
      {fit.beyond && fit.beyond.vertices > 0 && (
        <small>The target ends before {fit.beyond.vertices} vertices: nothing on it answers to them, and they follow the rest.</small>
      )}
      {fit.notes?.map((note) => (
        <small class="warn" key={note}>
          <Linked text={note} />
        </small>
      ))}
    </Section>
  )
}

// Markers that lie off their model, in the words that import has for them.
function Warnings() {
  const [warnings, setWarnings] = useState<string[]>([])
  const places = `${placesOf(app.store.document)} ${app.info('source')?.hash} ${app.info('target')?.hash}`
  useEffect(() => {
    let mine = true
    void app.saver.flush().then(api.warnings).then((told) => mine && setWarnings(told), () => {})
    return () => void (mine = false)
  }, [places])
  return (
    <>
      {warnings.map((warning) => (
        <small class="warn" role="status" key={warning}>
          <Linked text={warning} />
        </small>
      ))}
    </>
  )
}

export function FitPanel() {
  const fit = app.state?.fit
  const complete = app.store.document.markers.filter(isComplete).length
  const running = app.running && app.job.kind === 'fit'
  const ready = app.info('source') && app.info('target')
  return (
    <>
      <Section title="Fit" aside={`${complete} markers`}>
        <p class="hint">Brings the source's mesh onto the target's surface, led by the markers.</p>
        {running ? (
          <>
            <JobBar kind="fit" />
            <Button onClick={() => void app.attempt(() => api.cancel())} keys="Escape" title="Stop and keep what was there before">
              Cancel
            </Button>
          </>
        ) : (
          <Button primary disabled={!ready || app.running || app.readOnly} onClick={() => void startFit()}>
            {fit ? 'Fit again' : 'Fit'}
          </Button>
        )}
        {complete < 3 && <small class="warn">With fewer than three markers on both models, turn and size are a guess; 30 to 50 serve well.</small>}
        <Warnings />
        <details>
          <summary>Options</summary>
          <OptionForm of="fit" rows={app.state?.schema.fit ?? []} />
        </details>
      </Section>
      {fit && !running && <Outcome fit={fit} />}
      {fit && !running && (
        <Button primary={!app.stale} onClick={() => app.set({ step: 'morph' })}>
          Go on to the morph
        </Button>
      )}
    </>
  )
}
