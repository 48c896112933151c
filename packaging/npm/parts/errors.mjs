// errors.mjs - what is thrown, and how it shows the values that callers gave.

export class TriboxError extends Error {
    name = 'TriboxError';
}

const withArticle = (noun) => `${/^[AEIOU]/.test(noun) ? 'an' : 'a'} ${noun}`;

/** A value in a few words. */
export function shown(value) {
    if (typeof value === 'string')
        return JSON.stringify(value.length > 40 ? `${value.slice(0, 37)}...` : value);
    if (typeof value === 'function')
        return 'a function';
    if (typeof value !== 'object' || value === null)
        return Object.is(value, -0) ? '-0' : String(value);
    const name = Object.prototype.toString.call(value) === '[object Object]' ? value.constructor?.name : undefined;
    if (name && name !== 'Object')
        return withArticle(name);
    if (Array.isArray(value) && value.length <= 4)
        return `[${value.map(shown).join(', ')}]`;
    if (typeof value.length === 'number')
        return `${withArticle(value.constructor?.name ?? 'list')} of ${value.length}`;
    const keys = Object.keys(value);
    return keys.length ? `an object with ${keys.slice(0, 4).join(', ')}${keys.length > 4 ? ', ...' : ''}` : 'an empty object';
}
