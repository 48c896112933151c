// steps.js - the pictures of the story: which mesh, what is asked of it, and whether the box moves by itself.

export const steps = [
    { scene: 'some', moves: true, isMeasured: true },
    { scene: 'one', hasCorners: true },
    { scene: 'some', moves: true },
    { scene: 'million', moves: true, size: 0.4, test: { byIndex: true } },
    { scene: 'grazing', test: { accuracy: 'fast' } },
    { scene: 'some', moves: true, test: { cells: true, resolution: 32 } },
];
