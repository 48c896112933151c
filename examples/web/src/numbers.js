// numbers.js - numbers as people and programs read them.

/** The shortest decimal that is read back as this float. */
export function shortest(float) {
    for (let digits = 1; digits <= 9; digits++) {
        const text = float.toPrecision(digits);
        if (Math.fround(Number(text)) === float) return String(Number(text));
    }
    return String(float);
}

export const whole = (number) => number.toLocaleString('en-US');

/** Three digits. */
export function three(number) {
    const digits = number >= 100 ? 0 : number >= 10 ? 1 : number >= 1 ? 2 : 3;
    return number.toFixed(digits);
}

export const milliseconds = (ms) => (ms < 0.1 ? `${three(1000 * ms)} µs` : `${three(ms)} ms`);
