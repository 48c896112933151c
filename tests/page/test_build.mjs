// test_build.mjs - scripts that install packages say why where there is no network, and which programs are missing.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, symlinkSync } from 'node:fs';
import { join } from 'node:path';
import { folder } from './meshes.mjs';

const root = join(import.meta.dirname, '../..');

export async function withoutNetwork() {
    for (const script of ['examples/web/build.sh', 'tests/page/run.sh']) {
        const BUILD = mkdtempSync(join(folder, 'build-'));
        const offline = {
            npm_config_registry: 'http://127.0.0.1:9',
            npm_config_noproxy: '127.0.0.1',
            npm_config_cache: join(BUILD, 'cache'),
            npm_config_fetch_retries: 0,
        };
        const { status, stderr } = spawnSync('sh', [join(root, script), join(BUILD, 'page.html')], {
            encoding: 'utf8',
            env: { ...process.env, ...offline, BUILD },
        });
        assert.equal(status, 1, script);
        assert.match(stderr, /ECONNREFUSED/, script);
    }
}

/** In a line: with none of the programs, and with some. */
export function withoutPackages() {
    const PATH = mkdtempSync(join(folder, 'path-'));
    const lineOf = () => {
        const page = join(PATH, 'page.html'), script = join(root, 'examples/web/build.sh'),
            { status, stderr } = spawnSync('/bin/sh', [script, page], { encoding: 'utf8', env: { PATH } });
        assert.equal(status, 1);
        return stderr;
    };
    const placeOf = (name) => execFileSync('sh', ['-c', `command -v ${name}`], { encoding: 'utf8' }).trim();
    const link = (name) => symlinkSync(placeOf(name), join(PATH, name));
    link('dirname');
    assert.equal(lineOf(), 'build.sh: packages are missing: apt-get install nodejs npm clang-19 lld-19\n');
    for (const name of ['node', 'npm', 'wasm-ld-19']) link(name);
    assert.equal(lineOf(), 'build.sh: packages are missing: apt-get install clang-19\n');
}
