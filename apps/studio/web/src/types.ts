// What the page and the program tell each other.
export type Vec3 = [number, number, number]
export type Side = 'source' | 'target'
export const sides: Side[] = ['source', 'target']
export const other = (side: Side): Side => (side === 'source' ? 'target' : 'source')

export interface Marker {
  id: string
  name: string
  source: Vec3 | null // in the mesh's own coordinates
  target: Vec3 | null
  locked: boolean
  twin?: string
}

export interface Symmetry {
  on: boolean
  axis: number // 0, 1, 2: the plane's normal is x, y or z
  source: number // where the plane cuts the axis, from the box's centre, in parts of the diagonal
  target: number
}

// A touch of the brush: what lies within moves between two moments of the whole.
export interface Dab {
  at: Vec3 // in the source's own coordinates
  radius: number // parts of the source's diagonal
  start: number
  end: number
}

export type Options = Record<string, number | string>

// A model's file: where it lies, in the project's folder or elsewhere, and the hash of its bytes.
export interface ModelRef {
  path: string
  hash: string
}

// All that a person makes, and all that undo brings back.
export interface Document {
  models: Record<Side, ModelRef | null>
  markers: Marker[]
  symmetry: Symmetry
  timing: { dabs: Dab[] } // of several dabs on a place the last one counts
  options: { fit: Options; morph: Options }
}

export interface Frame {
  centre: Vec3
  scale: number
}

export interface MeshInfo {
  name: string
  path: string
  hash: string
  vertices: number
  triangles: number
  frame: Frame
  colors: boolean
  uvs: boolean
  findings: { warning: boolean; what: string }[]
  notes: string[] // what was passed over or decided while the file was read
}

// A model that might become one side of the project, and where the side's markers lie on it.
export interface Examined extends MeshInfo {
  model: ModelRef
  carried: { id: string; at: Vec3 | null }[]
}

export interface ImportedMarker {
  name: string
  source: Vec3 | null
  target: Vec3 | null
}

export interface ProjectInfo {
  id: string
  source: string
  target: string
  markers: number
  complete: number
  fitted: boolean
  saved: number // milliseconds since 1970
  picture: boolean
  open: boolean
}

export interface KeptState {
  name: string
  saved: number
  markers: number
}

export interface Stats {
  mean: number
  rms: number
  median: number
  p95: number
  p99: number
  max: number
}

export interface FitSummary {
  quality: {
    fitted_to_target: Stats
    target_to_fitted: Stats
    flipped_faces: number
    self_intersections: number
    self_intersections_source: number
    self_intersections_target: number
    marker_error?: Stats
    [name: string]: unknown
  }
  marker_errors: Record<string, number>
  guards: {
    flips_left: number // without those beyond the target
    flipped: { triangle: number; at: Vec3 }[]
    cuts: { triangles: [number, number]; at: Vec3 }[]
  }
  beyond?: { vertices: number; flipped_faces: number } // where the target ends before the mesh does
  worst: { vertex: number; fault: string; value: number; source: Vec3; fitted: Vec3 }[]
  notes?: string[]
}

export interface OptionRow {
  name: string
  label: string
  help: string
  type: 'number' | 'choice'
  default: number | string
  min?: number
  max?: number
  choices?: string[]
  when?: [string, string] // another option and its choice without which this one says nothing
}

export interface PathInfo {
  key: string
  asked: string // the request that it answers
  meshes: number // control meshes, weighted by a B-spline of this degree on these knots
  degree: number
  knots: number[]
  deviation: number
  bent: number // places that were moved aside because they cut each other on the way
  cuts_left: number // places that still do
  frame: Frame
}

export interface Job {
  kind?: 'fit' | 'morph' | 'export'
  state?: 'running' | 'done' | 'cancelled' | 'failed'
  fraction?: number
  stage?: string
  error?: string
  result?: unknown
}

export interface State {
  project: { number: number; id: string; file: string; folder: string }
  document: { models: Record<Side, ModelRef | null>; markers: Marker[]; symmetry: Partial<Symmetry>; timing: { dabs?: Dab[] }; options: { fit?: Options; morph?: Options } }
  meshes: Record<Side, MeshInfo | null>
  fit: FitSummary | null
  fit_is_of_these_markers: boolean
  result_frame?: Frame
  paths: PathInfo[]
  job: Job
  schema: { fit: OptionRow[]; morph: OptionRow[] }
  samples: { name: string; description: string }[]
  mesh_formats: string[]
  most_upload: number // bytes
  notes: string[]
}
