// Markers from files and to files.
import { api, downloadBlob } from '../api'
import { app } from '../app'
import { merge } from '../edits'
import { sides, type Side } from '../types'

export async function importMarkers(files: File[], side?: Side): Promise<void> {
  if (!app.info('source') || !app.info('target')) return app.toast('Open both models first: then the studio can tell which side a file is of.', true)
  if (files.length > 2) app.toast(`${files.length} files at once: markers come in one file, or in one a side.`, true)
  const name = files.map((file) => file.name).join(' and ')
  const told = await app.attempt(() => api.importMarkers(files.slice(0, 2), side), 'Reading markers')
  if (!told) return
  if (told.ask_side) {
    const answer = await app.ask({
      title: `Which side is ${name} of?`,
      lines: ['It holds points of one model only, and nothing in it tells of which.'],
      choices: sides.map((one) => ({ label: one === 'source' ? 'The source' : 'The target', answer: one, aside: app.info(one)?.name })),
    })
    return answer ? importMarkers(files, answer as Side) : undefined
  }
  const { after, added, moved, locked } = merge(app.store.document, told.markers)
  if (added + moved > 0) app.store.edit(`import ${told.markers.length} markers`, () => after)
  app.tell(name, told.notes)
  const counts = [`${added} markers added`, moved && `${moved} of the same name moved`, locked && `${locked} locked ones left`]
  app.toast(`${counts.filter(Boolean).join(', ')}, from ${name}.`)
  app.set({ step: 'markers' })
}

export const markerFormats: [string, string][] = [
  ['csv', 'CSV, both sides'],
  ['pp', 'MeshLab .pp'],
  ['fcsv', 'Slicer .fcsv'],
  ['mrk.json', 'Slicer .mrk.json'],
  ['json', 'Wrap .json'],
  ['pts', 'Landmark .pts'],
  ['tps', 'tps, both sides'],
]

export const exportMarkers = (format: string) =>
  app.attempt(async () => {
    await app.saver.flush()
    const { files, notes } = await api.exportMarkers(format)
    for (const { name, text } of files) downloadBlob(new Blob([text]), name)
    app.tell(files.map(({ name }) => name).join(' and '), notes)
  }, 'Writing markers')
