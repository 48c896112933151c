// command.js - the same question to the program on a command line.
import { textOfBox } from './box.js';

const GROUPS = [
    [1, 'box'],
    [2, 'plane'],
    [4, 'edges'],
];

const quote = (name) => (/^[\w.,+-]+$/.test(name) && !name.startsWith('-') ? name : `'./${name.replaceAll("'", "'\\''")}'`);

export function commandOf(name, box, test) {
    const words = ['tribox overlap', name ? quote(name) : 'MESH'];
    words.push(`${box.turned ? '--oriented' : '--box'}=${textOfBox(box)}`);
    if (!box.turned) words.push('--inside');
    if (test.accuracy !== 'exact') words.push('--accuracy', test.accuracy);
    if (test.axes !== 7)
        words.push(
            '--axes',
            GROUPS.filter(([bit]) => test.axes & bit)
                .map(([, word]) => word)
                .join(','),
        );
    if (test.order) words.push('--order', test.order);
    return words.join(' ');
}
