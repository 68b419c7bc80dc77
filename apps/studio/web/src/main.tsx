import { render } from 'preact'
import { app } from './app'
import { listenToKeys } from './keys'
import * as placing from './placing'
import * as painting from './painting'
import { Page } from './ui/page'
import { wire } from './work'
import { sides } from './types'
import './style.css'

const theme = localStorage.getItem('meshtween-theme')
if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme

for (const side of sides)
  app.stage.add(side, {
    click: (hit, pin) => placing.clicked(side, hit, pin),
    dragStart: (pin, hit) => placing.mayDrag(pin) || painting.begin(side, hit),
    drag: (hit) => painting.paint(hit) || placing.dragged(side, hit),
    dragEnd: () => painting.end() || placing.dropped(),
  })
app.stage.add('result', {})
app.stage.add('compare', {})
wire()
Object.assign(window, { studio: app }) // for the browser's console and the tests
listenToKeys()
render(<Page />, document.getElementById('app')!)
void app.start()
