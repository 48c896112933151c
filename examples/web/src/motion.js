// motion.js - the box moves by itself while a button is pressed.

export class Motion {
    /** place is handed a function that moves a box with a centre. */
    constructor(button, place) {
        this.button = button;
        this.place = place;
        this.time = 0;
        this.isForbidden = false; // by who pressed Stop
        button.addEventListener('click', () => {
            this.isForbidden = Boolean(this.isRunning);
            if (this.isRunning) this.stop();
            else this.run();
        });
    }

    runUntilTouched() {
        if (!this.isForbidden && !this.isRunning) this.run();
    }

    run() {
        this.isRunning = true;
        this.show();
        let before = performance.now();
        const step = (now) => {
            if (!this.isRunning) return;
            this.time += Math.min(now - before, 100) / 1000;
            before = now;
            this.place((...box) => this.moved(...box));
            requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    stop() {
        this.isRunning = false;
        this.show();
    }

    show() {
        this.button.setAttribute('aria-pressed', this.isRunning);
        this.button.textContent = this.isRunning ? 'Stop' : 'Play';
    }

    /** half: the size that the box has, however far it began with it. */
    moved({ center, half: first }, half) {
        const waves = [0.61, 0.83, 0.47], reach = Math.max(...first) * 1.3;
        return { center: center.map((c, a) => c + reach * Math.sin(waves[a] * this.time)), half };
    }
}
