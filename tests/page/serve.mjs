// serve.mjs - the page over http, with or without the headers that allow shared memory.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';

const isolated = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** Runs work(url) while the page is served. */
export async function served(areHeadersWanted, work) {
    const page = await readFile(process.env.PAGE);
    const server = createServer((request, response) => {
        response.writeHead(200, { 'Content-Type': 'text/html; charset=utf-8', ...(areHeadersWanted && isolated) });
        response.end(page);
    });
    await new Promise((go) => server.listen(0, '127.0.0.1', go));
    try {
        await work(`http://127.0.0.1:${server.address().port}/`);
    } finally {
        server.close();
        server.closeAllConnections();
    }
}
