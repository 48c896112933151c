// chart.js - nanoseconds a triangle as bars, in a list that reads as well without them.
import { three, whole } from './numbers.js';

const WORDS = { paper: "the paper's", exact: 'tribox' };

function bar({ name, ns }, paper, most) {
    const word = document.createElement('dt'),
        value = document.createElement('dd'),
        length = document.createElement('i');
    const text = document.createElement('span'),
        number = document.createElement('b');
    word.textContent = WORDS[name];
    length.style.width = `calc((100% - 104px) * ${ns / most})`;
    number.textContent = three(ns);
    text.append(number, ' ns');
    if (name !== 'paper') text.append(`, ${(paper / ns).toFixed(1)}×`);
    value.append(length, text);
    value.className = name;
    return [word, value];
}

/** How many times as fast as the paper's. */
export const factorOf = ({ rows }) => rows[0].ns / rows[1].ns;

export function drawChart(to, { rows, rounds, triangles }, kernel) {
    const list = document.createElement('dl'),
        note = document.createElement('p');
    const [{ ns: paper }] = rows,
        most = Math.max(...rows.map((row) => row.ns));
    list.className = 'bars';
    list.append(...rows.flatMap((row) => bar(row, paper, most)));
    note.className = 'note';
    note.textContent =
        `Nanoseconds a triangle for this box: ${whole(triangles)} triangles on one thread, the least of ${rounds} rounds. ` +
        `The paper's algorithm is in the same WebAssembly as tribox's ${kernel}.`;
    to.replaceChildren(list, note);
}
