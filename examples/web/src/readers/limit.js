// limit.js - how many triangles a mesh may have, asked while they are gathered: a list far beyond it ends the whole tab.

const MOST_MILLIONS = 8; // what the memory of a page carries, drawn and asked

export function refuseTooMany(triangles) {
    if (triangles > MOST_MILLIONS * 1e6)
        throw new Error(
            `has more than ${MOST_MILLIONS} million triangles, which is more than this page draws. ` +
                'Thin the mesh out, or use the program tribox.',
        );
}
