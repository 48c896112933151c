// axes_view.js - the thirteen axes as small bars: above the box, below the triangle, and lit what lies between them.

function bar(className) {
    const made = document.createElement('i');
    made.className = className;
    return made;
}

function item({ letter, number, group }) {
    const made = document.createElement('li'),
        name = document.createElement('var');
    name.append(letter);
    if (number) name.append(Object.assign(document.createElement('sub'), { textContent: number }));
    const track = document.createElement('span');
    track.append(bar('of-box'), bar('of-triangle'), bar('gap'));
    made.className = group;
    made.append(name, track);
    return made;
}

/** From and to are shares of the width. */
function put(element, from, to) {
    element.style.left = `${100 * from}%`;
    element.style.width = `${Math.max(0, 100 * (to - from))}%`;
}

/** Fills a list with bars; returns what shows the axes of axes.js in it. */
export function makeAxesView(list) {
    let items = null;
    return (axes) => {
        items ??= axes.map(item);
        if (!list.children.length) list.append(...items);
        axes.forEach(({ letter, number, lo, hi, r, gap }, i) => {
            const span = 1.15 * Math.max(r, Math.abs(lo), Math.abs(hi)) || 1,
                at = (x) => 0.5 + x / span / 2;
            const [ofBox, ofTriangle, between] = items[i].lastChild.children;
            put(ofBox, at(-r), at(r));
            put(ofTriangle, at(lo), at(hi));
            put(between, lo > r ? at(r) : at(hi), lo > r ? at(lo) : at(-r));
            items[i].classList.toggle('is-apart', gap > 0);
            items[i].setAttribute('aria-label', `${letter}${number}: ${gap > 0 ? 'a gap' : 'no gap'}`);
        });
    };
}
