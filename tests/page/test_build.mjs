// test_build.mjs - scripts that install packages say why where there is no network.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
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
