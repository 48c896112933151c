// theme.js - dark or light: what the system prefers, until the button is pressed. Colours of the stage come from the style sheet.

const names = ['missed', 'straddling', 'inside', 'unlike', 'box', 'cells'];

function coloursOf(root) {
    const style = getComputedStyle(root);
    return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** paint is called with the colours now and at every change. */
export function startTheme(button, paint) {
    const root = document.documentElement,
        system = matchMedia('(prefers-color-scheme: light)');
    let chosen = null;
    const apply = () => {
        const theme = chosen ?? (system.matches ? 'light' : 'dark');
        root.dataset.theme = theme;
        button.textContent = theme === 'dark' ? 'Light' : 'Dark';
        paint(coloursOf(root));
    };
    button.addEventListener('click', () => {
        chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
        apply();
    });
    system.addEventListener('change', apply);
    apply();
}
