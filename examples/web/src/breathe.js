// breathe.js - lets a Worker answer what else has come in, without the pauses that timers have.

export const breathe = () =>
    new Promise((go) => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => {
            port1.close();
            go();
        };
        port2.postMessage(0);
    });
