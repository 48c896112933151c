// bundle.mjs - makes one HTML file of the page, in a folder with node_modules: bundle.mjs FOLDER-OF-NPM-PACKAGE READ.wasm OUT.html
// TRIBOX_SOURCE and TRIBOX_DOCUMENTS are the addresses that it links to: the checkout beside the page and its README.md by default.
import { mkdir, readFile, rename, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join, relative, resolve } from 'node:path';

const [tribox, read, out] = process.argv.slice(2);
const here = import.meta.dirname, modules = resolve('node_modules');
const { build } = createRequire(join(modules, 'x'))('esbuild');

/** Names that begin with built: stand for what is made here. */
const built = (parts) => ({
    name: 'built',
    setup(from) {
        from.onResolve({ filter: /^built:/ }, ({ path }) => ({ path, namespace: 'built' }));
        from.onLoad({ filter: /.*/, namespace: 'built' }, ({ path }) => ({ contents: parts[path.slice(6)], loader: 'text' }));
    },
});

async function bundle(entry, parts = {}) {
    const { outputFiles } = await build({
        entryPoints: [join(here, entry)],
        bundle: true,
        write: false,
        minify: true,
        format: 'iife',
        target: 'es2022',
        charset: 'utf8',
        legalComments: 'inline',
        logLevel: 'warning',
        nodePaths: [modules],
        alias: { tribox: resolve(tribox, 'tribox.mjs') },
        define: { 'import.meta.url': '"file:///"' },
        plugins: [built(parts)],
    });
    return outputFiles[0].text;
}

const worker = await bundle('src/worker.js');
const maker = await bundle('src/maker.js');
const [wasm, readWasm] = await Promise.all([join(tribox, 'tribox.wasm'), read].map((path) => readFile(path, 'base64')));
const script = await bundle('src/main.js', { worker, maker, wasm, read: readWasm });
const checkout = relative(dirname(resolve(out)), resolve(here, '../..')) || '.';
const style = (await bundle('style.css')).trim();
const page = (await readFile(join(here, 'index.html'), 'utf8'))
    .replace('built:source', () => process.env.TRIBOX_SOURCE ?? `${checkout}/`)
    .replace('built:documents', () => process.env.TRIBOX_DOCUMENTS ?? `${checkout}/README.md`)
    .replace('/* built:style */', () => style).replace('/* built:script */', () => script.replaceAll('</script', '<\\/script'));

// Whole or not at all.
await mkdir(dirname(resolve(out)), { recursive: true });
await writeFile(`${out}.part`, page);
await rename(`${out}.part`, out);
