// read.js - a file as triangles of nine floats each, by the readers of the program; or an error that says what, where and what to
// do.

/** Which axis is up is not written in most files: what programs that write them mostly mean. */
const UP = { stl: 'z', obj: 'y', ply: 'y', off: 'z' };

const MOST = 8e6; // what the memory of a page carries, drawn and asked

const endingOf = (name) => (name.includes('.') ? name.slice(name.lastIndexOf('.') + 1).toLowerCase() : '');

/** A file is handed over in memory, so that what the C library calls for others is never called. */
const none = () => 8;
const wasi_snapshot_preview1 = { fd_close: none, fd_read: none, fd_seek: none, fd_write: none };

/** The whole file into the memory of the readers; say is told how much of it is there. */
async function fill(file, { exports }, say) {
    const room = exports.read_room(file.size) >>> 0;
    if (!room) throw new Error(`${file.name}: no memory for its ${file.size} bytes. Take a smaller one, or the program tribox.`);
    let at = room;
    for await (const chunk of file.stream()) {
        new Uint8Array(exports.memory.buffer).set(chunk, at);
        at += chunk.length;
        say((at - room) / file.size);
    }
}

function textAt({ exports }, address) {
    const bytes = new Uint8Array(exports.memory.buffer, address);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}

function nameFor({ exports }, name) {
    const bytes = new TextEncoder().encode(`${name}\0`), address = exports.malloc(bytes.length);
    new Uint8Array(exports.memory.buffer).set(bytes, address);
    return address;
}

/** Says each percent once. */
function inPercents(say) {
    let said = -1;
    return (share) => {
        const percent = Math.floor(100 * share);
        if (percent > said) say((said = percent) / 100);
    };
}

/** module: examples/web/read. say is told the share that is done, of reading the file and then of making triangles of it. */
export async function readMesh(file, module, say) {
    const up = UP[endingOf(file.name)], { name } = file;
    if (!up)
        throw new Error(`${name}: not a kind of file that this page reads. Export the mesh as .stl, .obj, .ply, .off or .glb.`);
    if (!file.size) throw new Error(`${name}: the file is empty. Export or download it again.`);
    const tell = inPercents(say);
    const reader = await WebAssembly.instantiate(module, {
        page: { tell: (done) => tell(0.5 + done / 2) },
        wasi_snapshot_preview1,
    });
    await fill(file, reader, (share) => tell(share / 2));
    const count = reader.exports.read_mesh(nameFor(reader, name)) >>> 0;
    if (!count) throw new Error(textAt(reader, reader.exports.read_message()));
    if (count > MOST)
        throw new Error(
            `${name}: has more than ${MOST / 1e6} million triangles, which is more than this page draws. ` +
                'Thin the mesh out, or use the program tribox.',
        );
    const address = reader.exports.read_triangles() >>> 0;
    if (!address) throw new Error(`${name}: no memory for its ${count} triangles. Take a smaller one, or the program tribox.`);
    return { name, triangles: new Float32Array(reader.exports.memory.buffer, address, 9 * count).slice(), up };
}
