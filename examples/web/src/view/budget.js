// budget.js - how much is drawn: fewer pixels while pictures follow each other, so that none takes long, and fewer triangles
// where there is no graphics card.

const SHARES = [1, 0.8, 0.65, 0.5, 0.4, 0.3], // of the pixels along a side
    SLOW_MS = 70, QUICK_MS = 50,
    SLOW_FRAMES = 3, // in a row, before fewer pixels are drawn
    QUICK_FRAMES = 20, // and before more are, twice as many each time that it was too early
    MOST_MS = 100, ENOUGH = 5;

/** What is drawn at most: triangles, and how often they may cover the picture. */
const SOFTWARE = { triangles: 16000, covers: 5 }, HARDWARE = { triangles: 4e6, covers: 60 };

/** Whether pictures are made by the processor. */
function isSoftware(gl) {
    const info = gl.getExtension('WEBGL_debug_renderer_info');
    return /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

/** The same before there is a canvas that counts, as antialiasing is chosen with it. */
export function drawsInSoftware() {
    const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
    if (!gl) return true;
    const answer = isSoftware(gl);
    gl.getExtension('WEBGL_lose_context')?.loseContext();
    return answer;
}

/** What is known after a picture that took so long. place: in SHARES; slow, quick: pictures in a row; patience: quick ones due. */
export function learn({ place, slow, quick, patience }, took) {
    slow = took > SLOW_MS ? slow + (took > 2 * SLOW_MS ? 2 : 1) : 0;
    quick = took < QUICK_MS ? quick + 1 : 0;
    if (slow >= SLOW_FRAMES && place < SHARES.length - 1) return { place: place + 1, slow: 0, quick: 0, patience: 2 * patience };
    if (quick >= patience && place > 0) return { place: place - 1, slow: 0, quick: 0, patience };
    return { place, slow, quick, patience };
}

export const unknown = (software) => ({ place: software ? 2 : 0, slow: 0, quick: 0, patience: QUICK_FRAMES });

/** The largest share at which a picture that stays takes no longer than MOST_MS, if one of all pixels takes so long. */
export const placeAtRest = (place, whole) => SHARES.findIndex((share, p) => p >= place || whole * share ** 2 < MOST_MS);

export class Budget {
    constructor(gl, software) {
        this.gl = gl;
        this.most = software ? SOFTWARE : HARDWARE;
        this.known = unknown(software);
        this.recent = []; // what the last pictures took, for all pixels
    }

    get share() {
        return SHARES[this.known.place];
    }

    get shareAtRest() {
        return SHARES[placeAtRest(this.known.place, Math.min(...this.recent))]; // others on the machine only ever add
    }

    /** Whether too few pictures were drawn to tell: the first take longer, as shaders are compiled. */
    get isUnsure() {
        return Boolean(this.gl) && this.recent.length < ENOUGH;
    }

    /** A picture was handed over: it is done once the fence behind it is. */
    began(isMoving) {
        if (!this.gl) return;
        this.start = performance.now();
        this.isMoving = isMoving;
        this.drawn = isMoving ? this.share : this.shareAtRest;
        this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    }

    /** Whether the picture before is still being drawn: a second one would only wait behind it. */
    isBusy() {
        const { gl, fence } = this;
        if (!fence) return false;
        if (!gl.isContextLost() && gl.clientWaitSync(fence, gl.SYNC_FLUSH_COMMANDS_BIT, 0) === gl.TIMEOUT_EXPIRED) return true;
        gl.deleteSync(fence);
        this.fence = null;
        const took = performance.now() - this.start;
        this.recent = [...this.recent.slice(-7), took / this.drawn ** 2];
        if (this.isMoving && !this.isUnsure) this.known = learn(this.known, took);
        return false;
    }
}
