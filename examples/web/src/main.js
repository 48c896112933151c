// main.js - starts the page, and hands on what is done to it.
import readerWasm from 'built:read';
import wasm from 'built:wasm';
import { Engine, makeMesh } from './engine.js';
import { readGlb } from './glb.js';
import { Motion } from './motion.js';
import { Page } from './page.js';
import { makeChoice, Panel } from './panel.js';
import { scenes } from './scenes/scenes.js';
import { Story } from './story.js';
import { addBoxKeys } from './view/box_keys.js';
import { BoxView } from './view/box_view.js';
import { Cells } from './view/cells.js';
import { Figure } from './view/figure.js';
import { NodeBoxes } from './view/node_boxes.js';
import { Stage } from './view/stage.js';
import { Triangles } from './view/triangles.js';

/* Dark or light: what the system prefers, until the button is pressed. */
const names = ['missed', 'straddling', 'inside', 'unlike', 'box', 'soft', 'cells'];

function coloursOf(root) {
    const style = getComputedStyle(root);
    return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** paint is called with the colours now and at every change. */
function startTheme(button, paint) {
    const root = document.documentElement, system = matchMedia('(prefers-color-scheme: light)');
    let chosen = null;
    const apply = () => {
        const theme = chosen ?? (system.matches ? 'light' : 'dark');
        root.dataset.theme = theme;
        button.textContent = theme === 'dark' ? 'Light' : 'Dark';
        paint(coloursOf(root));
    };
    button.addEventListener('click', () => {
        chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
        apply();
    });
    system.addEventListener('change', apply);
    apply();
}

/** Files that are dropped on the page. */
function takeDrops(body, onFile) {
    let depth = 0; // dragenter and dragleave come from every element on the way
    const show = () => body.classList.toggle('is-dragging', depth > 0);
    body.addEventListener('dragenter', (event) => {
        event.preventDefault();
        depth++;
        show();
    });
    body.addEventListener('dragleave', () => {
        depth--;
        show();
    });
    body.addEventListener('dragover', (event) => event.preventDefault());
    body.addEventListener('drop', (event) => {
        event.preventDefault();
        depth = 0;
        show();
        const [file] = event.dataTransfer.files;
        if (file) onFile(file);
    });
}

const element = (id) => document.getElementById(id);
const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
const given = new URLSearchParams(location.search); // ?workers=1; ?scene=million opens the console; ?step=3

const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

function startView(onBox, onTriangle, onAxis) {
    const stage = new Stage(element('canvas'), isStill, element('tools'), element('answer'));
    document.body.classList.toggle('is-blind', stage.isBlind);
    const view = {
        stage,
        triangles: new Triangles(stage),
        cells: new Cells(stage),
        nodes: new NodeBoxes(stage),
        figure: new Figure(stage, element('figure'), onTriangle, onAxis),
        box: new BoxView(stage, onBox),
    };
    stage.lookFrom('z');
    addBoxKeys(stage, view.box, makeChoice(element('mode'), (mode) => view.box.setMode(mode)));
    startTheme(element('theme'), (colours) => {
        for (const painted of [view.triangles, view.cells, view.nodes, view.figure, view.box]) painted.paint(colours);
    });
    return view;
}

let wishes = 0;

/** Shows what `make` returns once the page has said that it is busy, unless another is wished for meanwhile. */
async function showMade(page, panel, make) {
    const mine = ++wishes, isLatest = () => mine === wishes;
    panel.busy(true);
    try {
        const mesh = await make((text) => isLatest() && panel.progress(text));
        if (!isLatest()) return;
        await page.show(mesh);
        if (isLatest()) panel.clearMessage('file');
    } catch (error) {
        if (isLatest()) panel.say('file', error.message);
    } finally {
        if (isLatest()) {
            panel.busy(false);
            panel.progress('');
        }
    }
}

/** How a scene, or a file, becomes a mesh. */
function makersOf(page, panel) {
    const { most } = page.view.stage.budget, reader = WebAssembly.compile(bytesOf(readerWasm)), files = new Map();
    const isGlb = (file) => /\.glb$/i.test(file.name);
    const readFile = async (file, say) => {
        const onNews = (share) => say(`Reading ${file.name}: ${Math.floor(100 * share)} %`);
        onNews(0);
        const mesh = isGlb(file)
            ? await makeMesh('place', { mesh: await readGlb(file), most })
            : await makeMesh('read', { file, reader: await reader, most }, onNews);
        files.set(file.name, file);
        panel.addFile(file.name);
        return mesh;
    };
    return {
        showFile: (file) => showMade(page, panel, (say) => readFile(file, say)),
        showScene(name) {
            if (name.startsWith('file:')) return this.showFile(files.get(name.slice(5)));
            panel.showScene(name);
            return showMade(page, panel, async (say) => {
                say(`${scenes[name].title} …`);
                return { ...(await makeMesh('make', { scene: name, most })), box: scenes[name].box };
            });
        },
    };
}

function listen(page, panel, motion, story) {
    const makers = makersOf(page, panel);
    const showFile = (file) => {
        story.close();
        return makers.showFile(file);
    };
    panel.onTest = () => {
        page.ask();
        page.voxelize();
    };
    panel.onCells = page.voxelize;
    panel.onMeasure = () => page.measure();
    panel.onFile = showFile;
    panel.onScene = (name) => makers.showScene(name);
    panel.onNumbers = (text) => {
        motion.stop();
        page.placeText(text);
    };
    element('reset').addEventListener('click', () => {
        motion.stop();
        page.reset();
        story.restart();
    });
    takeDrops(document.body, showFile);
}

async function start() {
    const panel = new Panel();
    try {
        const workers = Number(given.get('workers')) || Math.min(2, navigator.hardwareConcurrency || 1);
        const starting = Engine.start(bytesOf(wasm), workers);
        let page = null, story = null;
        const place = (moved) => page?.mesh && page.placeBox(moved(page.mesh.box, page.halfLengths()));
        const motion = new Motion(element('play'), place);
        const view = startView(
            () => {
                motion.stop();
                page?.boxMoved();
            },
            (triangle) => story?.reshape(triangle),
            () => story?.tell(),
        );
        page = new Page(panel, await starting, view);
        story = new Story(page, panel, isStill ? null : motion);
        listen(page, panel, motion, story);
        if (scenes[given.get('scene')]) {
            story.close();
            await panel.onScene(given.get('scene'));
        } else await story.open(Number(given.get('step')) || 0);
    } catch (error) {
        panel.say('start', `The page does not start: ${error.message}. It needs WebAssembly with SIMD.`);
    }
}

start();
