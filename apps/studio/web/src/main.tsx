import { render } from 'preact'
import { app } from './app'
import { listenToKeys } from './keys'
import * as placing from './placing'
import { Page } from './ui/page'
import { wire } from './work'
import { sides } from './types'
import './style.css'

const theme = localStorage.getItem('meshtween-theme')
if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme

for (const side of sides)
  app.stage.add(side, {
    click: (hit, pin) => placing.clicked(side, hit, pin),
    dragStart: placing.mayDrag,
    drag: (hit) => placing.dragged(side, hit),
    dragEnd: placing.dropped,
  })
app.stage.add('result', {})
app.stage.add('compare', {})
wire()
Object.assign(window, { studio: app }) // for the browser's console and the tests
listenToKeys()
render(<Page />, document.getElementById('app')!)
void app.start()
