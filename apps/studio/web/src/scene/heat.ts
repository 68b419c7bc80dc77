// Values on vertices as colours: dark blue for the least through green to yellow (viridis, van der Walt and Smith 2015).
const stops = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141],
  [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
]

export function heatColor(t: number): [number, number, number] {
  const at = Math.min(1, Math.max(0, t)) * (stops.length - 1)
  const i = Math.min(stops.length - 2, Math.floor(at))
  const mix = (k: number) => stops[i][k] + (stops[i + 1][k] - stops[i][k]) * (at - i)
  return [mix(0), mix(1), mix(2)]
}

export const heatGradient = `linear-gradient(90deg, ${stops.map((stop) => `rgb(${stop.join(' ')})`).join(', ')})`

// The value under which 99 % of the values lie.
export function most(values: Float32Array): number {
  const sorted = Float32Array.from(values).sort()
  return sorted[Math.floor(0.99 * (sorted.length - 1))] || 1e-6
}

export function heatColors(values: Float32Array, from: number, to: number): Uint8Array {
  const table = new Uint8Array(3 * 256)
  for (let i = 0; i < 256; ++i) table.set(heatColor(i / 255), 3 * i)
  const colors = new Uint8Array(4 * values.length)
  for (let i = 0; i < values.length; ++i) {
    const k = 3 * Math.round(255 * Math.min(1, Math.max(0, (values[i] - from) / (to - from))))
    colors[4 * i] = table[k]
    colors[4 * i + 1] = table[k + 1]
    colors[4 * i + 2] = table[k + 2]
    colors[4 * i + 3] = 255
  }
  return colors
}
