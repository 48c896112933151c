// bit_texture.js - a mask as a texture of 32-bit words, so that a shader asks for the bit of its triangle.
import { DataTexture, NearestFilter, RedIntegerFormat, UnsignedIntType } from 'three';

const WIDTH = 1024;

export class BitTexture {
    constructor(bits) {
        const height = Math.max(1, Math.ceil(bits / 32 / WIDTH));
        this.words = new Uint32Array(WIDTH * height);
        this.texture = new DataTexture(this.words, WIDTH, height, RedIntegerFormat, UnsignedIntType);
        this.texture.internalFormat = 'R32UI';
        this.texture.minFilter = this.texture.magFilter = NearestFilter;
        this.texture.needsUpdate = true;
    }

    /** words: null for none set. */
    set(words) {
        if (words) this.words.set(words);
        else this.words.fill(0);
        this.texture.needsUpdate = true;
    }

    dispose() {
        this.texture.dispose();
    }
}

export const readBit = /* glsl */ `
bool bit_of(highp usampler2D words, int i) {
    int word = i >> 5;
    return (texelFetch(words, ivec2(word & ${WIDTH - 1}, word / ${WIDTH}), 0).r >> uint(i & 31) & 1u) == 1u;
}`;
