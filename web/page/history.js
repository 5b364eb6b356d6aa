// The history of a tab: every state of its spec, in order. Nothing that was in it is lost: a change after an undo keeps what was undone.

/** Largest number of states, and of letters in all of them. */
const MOST_STATES = 200, MOST_LETTERS = 2_000_000;

/** Whether two states are the same spec with the same files. */
export const isSame = (a, b) => a.text === b.text && a.machine === b.machine && a.drawing?.hash === b.drawing?.hash && a.drawing?.name === b.drawing?.name;

export class History {
    #states;
    #index;
    /** The kind of the last change: changes of one kind become one step. */
    #kind = null;

    /** Begins with `states` at `index`. A state is { id, text, machine, drawing: { name, hash } }; `id` is that of its entry among the last specs. */
    constructor(states, index = states.length - 1) {
        this.#states = states;
        this.#index = index;
    }

    get state() {
        return this.#states[this.#index];
    }

    get canUndo() {
        return this.#index > 0;
    }

    get canRedo() {
        return this.#index < this.#states.length - 1;
    }

    /** The states and the index, to be stored. */
    get stored() {
        return { states: this.#states, index: this.#index };
    }

    /** Adds `state`. Changes of one `kind` (not null) that follow each other are one step. Returns whether anything changed. */
    push(state, kind = null) {
        if (isSame(state, this.state)) return false;
        const isLast = !this.canRedo;
        if (isLast && kind !== null && kind === this.#kind) this.#states[this.#index] = state;
        else {
            // What was undone stays behind, and the state from which the change began comes again.
            if (!isLast) this.#states.push(this.state);
            this.#states.push(state);
        }
        this.#kind = kind;
        this.#index = this.#states.length - 1;
        this.#shorten();
        return true;
    }

    /** Ends a step: the next change begins another one. */
    settle() {
        this.#kind = null;
    }

    /** Goes `by` steps back (-1) or forth (1); returns whether there was such a state. */
    go(by) {
        const index = this.#index + by;
        if (!this.#states[index]) return false;
        this.#index = index;
        this.#kind = null;
        return true;
    }

    /** Drops the oldest states beyond the limits. */
    #shorten() {
        const letters = () => this.#states.reduce((sum, { text, machine }) => sum + text.length + (machine?.length ?? 0), 0);
        while (this.#states.length > 1 && this.#index > 0 && (this.#states.length > MOST_STATES || letters() > MOST_LETTERS)) {
            this.#states.shift();
            this.#index -= 1;
        }
    }
}
