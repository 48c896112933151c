// run.mjs - runs the tests of the page one after another, in one browser: run.mjs [PART...]
import { readdir } from 'node:fs/promises';
import { close, closePages, forgetPages } from './browser.mjs';

const asked = process.argv.slice(2), here = import.meta.dirname;
const all = (await readdir(here)).map((name) => name.match(/^test_(\w+)\.mjs$/)?.[1]).filter(Boolean).sort();
const unknown = asked.find((part) => !all.includes(part));
if (unknown) throw new Error(`no test is called ${unknown}; there are: ${all.join(' ')}`);

let passed = 0, failed = 0;
for (const part of asked.length ? asked : all)
    for (const [name, test] of Object.entries(await import(`./test_${part}.mjs`))) {
        const start = performance.now();
        try {
            await test();
            await closePages();
            passed++;
            console.log(`ok      ${part}: ${name}, ${((performance.now() - start) / 1000).toFixed(1)} s`);
        } catch (error) {
            await forgetPages();
            failed++;
            console.log(`FAILED  ${part}: ${name}\n${error.stack}`);
        }
    }
await close();
console.log(`[  PASSED  ] ${passed} test(s).`);
if (failed) console.log(`[  FAILED  ] ${failed} test(s).`);
process.exit(failed ? 1 : 0);
