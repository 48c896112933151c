// numbers.js - numbers as people and programs read them.

export const whole = (number) => number.toLocaleString('en-US');

/** Three digits. */
export function three(number) {
    const digits = number >= 100 ? 0 : number >= 10 ? 1 : number >= 1 ? 2 : 3;
    return number.toFixed(digits);
}

export const milliseconds = (ms) => (ms < 0.1 ? `${three(1000 * ms)} µs` : `${three(ms)} ms`);
