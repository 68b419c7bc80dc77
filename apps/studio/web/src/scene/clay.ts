// How surfaces look: a studio-lit clay painted once into a sphere picture (a matcap), which costs one texture read.
import { CanvasTexture, SRGBColorSpace } from 'three'

export function clay(): CanvasTexture {
  const size = 256
  const canvas = document.createElement('canvas')
  canvas.width = canvas.height = size
  const context = canvas.getContext('2d')!
  const image = context.createImageData(size, size)
  const light = (nx: number, ny: number, nz: number, x: number, y: number, z: number) => {
    const length = Math.hypot(x, y, z)
    return Math.max(0, (nx * x + ny * y + nz * z) / length)
  }
  for (let j = 0; j < size; ++j)
    for (let i = 0; i < size; ++i) {
      let x = ((i + 0.5) / size) * 2 - 1
      let y = 1 - ((j + 0.5) / size) * 2
      const r = Math.hypot(x, y)
      if (r > 0.999) (x *= 0.999 / r), (y *= 0.999 / r)
      const z = Math.sqrt(Math.max(0, 1 - x * x - y * y))
      const key = light(x, y, z, -0.45, 0.65, 0.6)
      const fill = light(x, y, z, 0.8, 0.1, 0.45)
      const sky = 0.5 + 0.5 * y
      const shine = Math.pow(light(x, y, z, -0.28, 0.42, 0.87), 36)
      const rim = Math.pow(1 - z, 3) * (0.35 + 0.65 * Math.max(0, y * 0.7 + x * 0.5))
      const warm = 0.62 * key + 0.14 * shine
      const cool = 0.16 * fill + 0.2 * sky + 0.16 * rim + 0.08
      const at = 4 * (j * size + i)
      image.data[at] = 255 * Math.min(1, Math.pow(warm * 1.02 + cool * 0.93, 0.9))
      image.data[at + 1] = 255 * Math.min(1, Math.pow(warm * 0.98 + cool * 0.98, 0.9))
      image.data[at + 2] = 255 * Math.min(1, Math.pow(warm * 0.92 + cool * 1.1, 0.9))
      image.data[at + 3] = 255
    }
  context.putImageData(image, 0, 0)
  const texture = new CanvasTexture(canvas)
  texture.colorSpace = SRGBColorSpace
  return texture
}

export function checker(): CanvasTexture {
  const canvas = document.createElement('canvas')
  canvas.width = canvas.height = 512
  const context = canvas.getContext('2d')!
  for (let j = 0; j < 16; ++j)
    for (let i = 0; i < 16; ++i) {
      const hue = (i * 360) / 16
      context.fillStyle = (i + j) % 2 ? `hsl(${hue} 45% ${58 + j}%)` : `hsl(${hue} 30% ${84 - j}%)`
      context.fillRect(i * 32, j * 32, 32, 32)
    }
  const texture = new CanvasTexture(canvas)
  texture.colorSpace = SRGBColorSpace
  texture.anisotropy = 4
  return texture
}
