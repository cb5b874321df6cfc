// Undo and redo over whole states, which are small: the text of a skeleton file, and a mask that changes rarely.
export class History {
  #states = [];
  #at = -1;

  reset(state) {
    this.#states = [state];
    this.#at = 0;
  }
  push(state) {
    this.#states.splice(this.#at + 1, Infinity, state);
    this.#at = this.#states.length - 1;
  }
  get canUndo() { return this.#at > 0; }
  get canRedo() { return this.#at + 1 < this.#states.length; }
  undo() { return this.#states[--this.#at]; }
  redo() { return this.#states[++this.#at]; }
  get first() { return this.#states[0]; }
}
