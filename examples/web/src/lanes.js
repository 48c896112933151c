// lanes.js - eight triangles as the lanes of a register: which of them the library has found apart after each group of axes.
const TESTS = [[1, '3 box normals'], [3, 'triangle’s normal'], [7, '9 edge axes']]; // all axes up to here

const STATES = { apart: 'a gap', done: 'apart before', open: 'no gap yet', overlaps: 'overlaps' };

/** What to write into each lane of a row, of the triangles that it leaves, and that the row before left. */
const statesOf = (left, before, isLast) =>
    Array.from({ length: 8 }, (_, lane) => {
        const bit = 1 << lane;
        return !(before & bit) ? 'done' : !(left & bit) ? 'apart' : isLast ? 'overlaps' : 'open';
    });

export class Lanes {
    constructor(table) {
        this.rows = TESTS.map(([, name]) => {
            const row = table.insertRow(), head = document.createElement('th');
            Object.assign(head, { scope: 'row', textContent: name });
            row.append(head, ...Array.from({ length: 8 }, () => document.createElement('td')));
            return row;
        });
    }

    /** Returns how many overlap the box, by the library; null if another question came meanwhile. */
    async show(engine, box) {
        const mine = (this.last = {}), test = { accuracy: 'exact', order: 0 };
        const answers = await Promise.all(TESTS.map(([axes]) => engine.ask({ box, test: { ...test, axes }, byIndex: false })));
        if (mine !== this.last) return null;
        let before = 255;
        answers.forEach(({ mask }, t) => {
            this.rows[t].classList.toggle('is-left-out', before === 0);
            const states = statesOf(mask[0], before, t === TESTS.length - 1);
            states.forEach((state, lane) => {
                const cell = this.rows[t].cells[lane + 1];
                cell.className = state;
                cell.textContent = lane + 1;
                cell.setAttribute('aria-label', `triangle ${lane + 1}: ${STATES[state]}`);
            });
            before = mask[0];
        });
        return answers.at(-1).overlapping;
    }
}
