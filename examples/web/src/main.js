// main.js - starts the page: the stage, the Workers, the panel, and what passes between them.
import wasm from 'built:wasm';
import { allowedTest } from './allowed.js';
import { boxOfPose, boxOfText, poseBox } from './box.js';
import { drawChart } from './chart.js';
import { makeChoice } from './choices.js';
import { takeDrops } from './drop.js';
import { Engine } from './engine.js';
import { boundsOf, frameOf, gridAround } from './mesh.js';
import { Motion } from './motion.js';
import { Panel } from './panel.js';
import { readMesh } from './readers/read.js';
import { scenes } from './scenes/scenes.js';
import { startTheme } from './theme.js';
import { addBoxKeys } from './view/box_keys.js';
import { BoxView } from './view/box_view.js';
import { Cells } from './view/cells.js';
import { Stage } from './view/stage.js';
import { Triangles } from './view/triangles.js';

const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;
const given = new URLSearchParams(location.search); // ?workers=1, ?scene=million

const panel = new Panel();
let stage, triangles, cells, box, engine;
let mesh = null; // name, triangles, up, box, bounds, frame
let typed = null; // a box as typed, until the pose changes
let isAsking = false,
    isWanted = false;
let isVoxelizing = false,
    areCellsWanted = false;

const boxNow = () => typed ?? boxOfPose(box.pose, mesh.frame);

/** Asks about the box as it is; while an answer is awaited, only that it moved is remembered. */
async function ask() {
    isWanted = true;
    if (isAsking || !mesh || !engine) return;
    isAsking = true;
    try {
        while (isWanted) {
            isWanted = false;
            const asked = mesh,
                now = boxNow(),
                byIndex = panel.isByIndex();
            const { test, note } = allowedTest(panel.test(), now, byIndex),
                question = { box: now, test, byIndex };
            const answer = await engine.ask(question);
            if (asked !== mesh) continue;
            triangles.classify(answer);
            triangles.mark(panel.showAnswer(answer, question, asked, engine));
            panel.noteTest(note);
            settle(question);
        }
        panel.clearMessage('ask');
    } catch (error) {
        panel.say('ask', error.message);
    } finally {
        isAsking = false;
    }
}

const REST_MS = 150;
let resting = 0;

/** Once the box rests its time is measured again, as first calls run in code that browsers have compiled in a hurry. */
function settle(question) {
    clearTimeout(resting);
    resting = setTimeout(async () => {
        const asked = mesh,
            milliseconds = await engine.settle(question).catch(() => null);
        if (milliseconds !== null && asked === mesh && !isAsking) panel.showTime(milliseconds, question.byIndex, engine);
    }, REST_MS);
}

/** The same for cells. */
async function voxelize() {
    areCellsWanted = true;
    if (isVoxelizing || !mesh || !engine) return;
    isVoxelizing = true;
    try {
        while (areCellsWanted) {
            areCellsWanted = false;
            triangles.mesh.visible = !panel.wantsCells();
            if (!panel.wantsCells()) {
                cells.hide();
                panel.hideCells();
                continue;
            }
            const asked = mesh,
                resolution = panel.resolution(),
                test = { ...panel.test(), axes: 7, order: 0 };
            const grid = gridAround(asked.bounds, resolution),
                start = performance.now();
            const { bits, milliseconds } = await engine.voxelize(grid, test);
            if (asked !== mesh) continue;
            panel.showCells({
                ...cells.show(grid, bits, asked.frame),
                grid,
                resolution,
                milliseconds,
                wall: performance.now() - start,
            });
        }
        panel.clearMessage('cells');
    } catch (error) {
        triangles.mesh.visible = true;
        cells.hide();
        panel.say('cells', error.message);
    } finally {
        isVoxelizing = false;
    }
}

function placeBox(to) {
    typed = to.lo || to.turned ? to : null;
    poseBox(box.pose, mesh.frame, to);
    stage.draw();
    ask();
}

function boxFor({ lo, hi }) {
    const middle = lo.map((l, a) => (l + hi[a]) / 2),
        half = Math.max(...lo.map((l, a) => hi[a] - l)) / 5 || 1;
    return { center: middle.map((m, a) => m + (hi[a] - lo[a]) / 5), half: [half, half, half] };
}

async function show(next) {
    panel.busy(true);
    try {
        const bounds = boundsOf(next.triangles);
        if (!(bounds.lo[0] <= bounds.hi[0]))
            throw new Error(`${next.name}: none of its triangles has finite coordinates. Export it again.`);
        await engine.load(next.triangles);
        mesh = { ...next, bounds, frame: frameOf(bounds), box: next.box ?? boxFor(bounds) };
        triangles.show(mesh.triangles, mesh.frame);
        stage.lookFrom(mesh.up);
        panel.showMesh(mesh);
        placeBox(mesh.box);
        voxelize();
    } finally {
        panel.busy(false);
    }
}

async function showScene(name) {
    const { make, box } = scenes[name];
    panel.showScene(name);
    await nextFrame();
    await show({ box, triangles: make(), up: 'z' });
    panel.clearMessage('file');
}

/** Files come one after another, whatever becomes of each. */
async function showFile(file) {
    panel.busy(true);
    await nextFrame();
    try {
        await show(await readMesh(file));
        panel.clearMessage('file');
    } catch (error) {
        panel.say('file', error.message);
    } finally {
        panel.busy(false);
    }
}

const nextFrame = () => new Promise((go) => setTimeout(go, 0));

async function measure() {
    panel.measuring('warming up…');
    try {
        const now = boxNow();
        if (now.turned) throw new Error("The paper's test takes upright boxes. Press Reset, or type one.");
        const result = await engine.measure({ box: now, axes: panel.test().axes }, ({ stage: at }) => panel.measuring(`${at}…`));
        drawChart(panel.chart, result, engine.kernel);
    } catch (error) {
        panel.chartNote(error.message);
    } finally {
        panel.measured();
    }
}

function startStage() {
    stage = new Stage(document.getElementById('canvas'), isStill);
    triangles = new Triangles(stage);
    cells = new Cells(stage);
    box = new BoxView(stage, () => {
        typed = null;
        motion.stop();
        ask();
    });
    stage.addOrbit();
    const setMode = makeChoice(document.getElementById('mode'), (mode) => box.setMode(mode));
    addBoxKeys(stage, box, setMode);
    startTheme(document.getElementById('theme'), (colours) => {
        for (const painted of [triangles, cells, box]) painted.paint(colours);
    });
}

const motion = new Motion(document.getElementById('play'), (to) => {
    if (mesh) placeBox({ ...to(mesh.box) });
});

function listen() {
    panel.onTest = () => {
        ask();
        voxelize();
    };
    panel.onCells = voxelize;
    panel.onMeasure = measure;
    panel.onFile = showFile;
    panel.onScene = (name) => showScene(name).catch((error) => panel.say('file', error.message));
    panel.onNumbers = (text) => {
        const read = boxOfText(text);
        if (read) {
            motion.stop();
            placeBox(read);
        }
        return Boolean(read);
    };
    document.getElementById('reset').addEventListener('click', () => {
        motion.stop();
        if (!mesh) return;
        stage.lookFrom(mesh.up);
        placeBox(mesh.box);
    });
    takeDrops(document.body, showFile);
}

const bytesOf = (base64) => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

async function start() {
    try {
        startStage();
        listen();
        const workers = Number(given.get('workers')) || Math.min(2, navigator.hardwareConcurrency || 1);
        engine = await Engine.start(bytesOf(wasm), workers);
        await showScene(scenes[given.get('scene')] ? given.get('scene') : 'knot');
    } catch (error) {
        panel.say('start', `The page does not start: ${error.message}. It needs WebGL 2 and WebAssembly with SIMD.`);
    }
}

start();
