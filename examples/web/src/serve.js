// serve.js - questions to a Worker and their answers: messages in, messages out.

/** answers: a function for each `what`, handed the question and what tells news. onQuestion is called at each. */
export function serve(answers, onQuestion = () => {}) {
    self.onmessage = async ({ data }) => {
        onQuestion();
        try {
            const answer = await answers[data.what](data, (news) => self.postMessage({ id: data.id, news }));
            self.postMessage({ id: data.id, answer }, buffersOf(answer));
        } catch (error) {
            self.postMessage({ id: data.id, error: error.message || String(error) });
        }
    };
}

/** Those of its arrays, one or two names deep. */
function buffersOf(answer) {
    const buffers = new Set();
    for (const value of Object.values(answer))
        for (const inner of [value, ...(value?.constructor === Object ? Object.values(value) : [])])
            if (ArrayBuffer.isView(inner)) buffers.add(inner.buffer);
    return [...buffers];
}
