// drop.mjs - drops a file on the page, as a hand does.

export async function dropFile(page, name, content) {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    await page.evaluate(
        ([file, base64]) => {
            const data = new DataTransfer(),
                text = atob(base64);
            data.items.add(new File([Uint8Array.from(text, (letter) => letter.charCodeAt(0))], file));
            for (const type of ['dragenter', 'dragover', 'drop'])
                document
                    .querySelector('canvas')
                    .dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
        },
        [name, Buffer.from(bytes).toString('base64')],
    );
}
