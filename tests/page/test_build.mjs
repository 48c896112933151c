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
    const assertLacks = (script, ...packages) => {
        const words = [join(root, script), join(PATH, 'made')];
        const { status, stderr } = spawnSync('/bin/sh', words, { encoding: 'utf8', env: { PATH } });
        assert.equal(stderr, `build.sh: packages are missing: apt-get install ${packages.join(' ')}\n`);
        assert.equal(status, 1);
    };
    const placeOf = (name) => execFileSync('sh', ['-c', `command -v ${name}`], { encoding: 'utf8' }).trim();
    const link = (name) => symlinkSync(placeOf(name), join(PATH, name));
    link('dirname');
    assertLacks('examples/web/build.sh', 'nodejs', 'npm', 'clang-19', 'lld-19');
    assertLacks('packaging/npm/build.sh', 'clang-19', 'lld-19');
    for (const name of ['node', 'npm', 'wasm-ld-19']) link(name);
    for (const script of ['examples/web/build.sh', 'packaging/npm/build.sh']) assertLacks(script, 'clang-19');
}
