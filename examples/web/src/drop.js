// drop.js - files that are dropped on the page.

export function takeDrops(body, onFile) {
    let depth = 0; // dragenter and dragleave come from every element on the way
    const show = () => body.classList.toggle('is-dragging', depth > 0);
    body.addEventListener('dragenter', (event) => {
        event.preventDefault();
        depth++;
        show();
    });
    body.addEventListener('dragleave', () => {
        depth--;
        show();
    });
    body.addEventListener('dragover', (event) => event.preventDefault());
    body.addEventListener('drop', (event) => {
        event.preventDefault();
        depth = 0;
        show();
        const [file] = event.dataTransfer.files;
        if (file) onFile(file);
    });
}
