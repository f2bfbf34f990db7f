// Calls that follow each other quickly become one.

/** A function that runs a moment after its last call. */
export interface Debounced {
  (): void;
  /** Forgets a call that still waits. */
  cancel(): void;
}

/** Runs `action` once nobody has called for `delay` milliseconds. */
export function debounced(action: () => void, delay: number): Debounced {
  let waiting: NodeJS.Timeout | undefined;
  const cancel = (): void => clearTimeout(waiting);
  const call = (): void => {
    cancel();
    waiting = setTimeout(action, delay);
  };
  return Object.assign(call, { cancel });
}
