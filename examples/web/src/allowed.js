// allowed.js - what the library takes together: another choice of axes is answered in its place, and the page says so.

const BOX = 1,
    ALL = 7;

/** The test that is asked, and a note where it is not the one that was chosen. */
export function allowedTest(test, box, byIndex) {
    if (box.turned && test.axes !== ALL && test.axes !== BOX)
        return {
            test: { ...test, axes: ALL },
            note: 'A turned box is asked with all axes, or with the 3 of the box alone: all are taken.',
        };
    if (byIndex && !(test.axes & BOX))
        return { test: { ...test, axes: test.axes | BOX }, note: 'The index needs the 3 axes of the box: they are taken, too.' };
    return { test, note: '' };
}
