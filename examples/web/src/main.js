// main.js - starts the page, and hands on what is done to it.
import wasm from 'built:wasm';
import { makeChoice } from './choices.js';
import { takeDrops } from './drop.js';
import { Engine } from './engine.js';
import { Motion } from './motion.js';
import { Page } from './page.js';
import { Panel } from './panel.js';
import { readMesh } from './readers/read.js';
import { scenes } from './scenes/scenes.js';
import { startTheme } from './theme.js';
import { addBoxKeys } from './view/box_keys.js';
import { BoxView } from './view/box_view.js';
import { Cells } from './view/cells.js';
import { Stage } from './view/stage.js';
import { Triangles } from './view/triangles.js';

const element = (id) => document.getElementById(id);
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
const given = new URLSearchParams(location.search); // ?workers=1, ?scene=million

const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

function startView(onMove) {
    const stage = new Stage(element('canvas'), isStill),
        view = { stage, triangles: new Triangles(stage), cells: new Cells(stage), box: new BoxView(stage, onMove) };
    stage.addOrbit();
    addBoxKeys(
        stage,
        view.box,
        makeChoice(element('mode'), (mode) => view.box.setMode(mode)),
    );
    startTheme(element('theme'), (colours) => {
        for (const painted of [view.triangles, view.cells, view.box]) painted.paint(colours);
    });
    return view;
}

let wishes = 0;

/** Shows what `make` returns once the page has said that it is busy, unless another is wished for meanwhile. */
async function showMade(page, panel, make) {
    const mine = ++wishes,
        isLatest = () => mine === wishes;
    panel.busy(true);
    await new Promise((go) => setTimeout(go));
    try {
        const mesh = await make();
        if (!isLatest()) return;
        await page.show(mesh);
        if (isLatest()) panel.clearMessage('file');
    } catch (error) {
        if (isLatest()) panel.say('file', error.message);
    } finally {
        if (isLatest()) panel.busy(false);
    }
}

function sceneNamed(panel, name) {
    panel.showScene(name);
    const { make, box } = scenes[name];
    return { box, triangles: make(), up: 'z' };
}

function listen(page, panel, motion) {
    const showFile = (file) => showMade(page, panel, () => readMesh(file));
    panel.onTest = () => {
        page.ask();
        page.voxelize();
    };
    panel.onCells = page.voxelize;
    panel.onMeasure = () => page.measure();
    panel.onFile = showFile;
    panel.onScene = (name) => showMade(page, panel, () => sceneNamed(panel, name));
    panel.onNumbers = (text) => {
        motion.stop();
        return page.placeText(text);
    };
    element('reset').addEventListener('click', () => {
        motion.stop();
        page.reset();
    });
    takeDrops(document.body, showFile);
}

async function start() {
    const panel = new Panel();
    try {
        const workers = Number(given.get('workers')) || Math.min(2, navigator.hardwareConcurrency || 1);
        const starting = Engine.start(bytesOf(wasm), workers);
        let page = null;
        const motion = new Motion(element('play'), (moved) => page?.mesh && page.placeBox(moved(page.mesh.box)));
        const view = startView(() => {
            motion.stop();
            page?.boxMoved();
        });
        page = new Page(panel, await starting, view);
        listen(page, panel, motion);
        await panel.onScene(scenes[given.get('scene')] ? given.get('scene') : 'knot');
    } catch (error) {
        panel.say('start', `The page does not start: ${error.message}. It needs WebGL 2 and WebAssembly with SIMD.`);
    }
}

start();
