// choices.js - rows of buttons of which one is chosen, as a group of radio buttons: arrows move, one stop for Tab.

export function makeChoice(group, onChoice) {
    const buttons = [...group.querySelectorAll('[role="radio"]')];
    const choose = (value, isByUser = false) => {
        for (const button of buttons) {
            const isChosen = button.value === value;
            button.setAttribute('aria-checked', isChosen);
            button.tabIndex = isChosen ? 0 : -1;
            if (isChosen && isByUser) button.focus();
        }
        onChoice(value);
    };
    group.addEventListener('click', (event) => {
        const button = event.target.closest('[role="radio"]');
        if (button) choose(button.value);
    });
    group.addEventListener('keydown', (event) => {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (!step) return;
        event.preventDefault();
        const at = buttons.findIndex((button) => button.getAttribute('aria-checked') === 'true');
        choose(buttons[(at + step + buttons.length) % buttons.length].value, true);
    });
    return choose;
}
