// latest.js - work that takes a while, for the latest wish alone: wishes that come meanwhile are one.

/** Returns a function that asks for `work`. onError is handed what went wrong, or null when nothing did. */
export function latest(work, onError) {
    let isBusy = false,
        isWanted = false;
    return async () => {
        isWanted = true;
        if (isBusy) return;
        isBusy = true;
        try {
            while (isWanted) {
                isWanted = false;
                await work();
            }
            onError(null);
        } catch (error) {
            onError(error);
        } finally {
            isBusy = false;
        }
    };
}
