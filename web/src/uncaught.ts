/** Throws a failure where the page of a worker hears of it: as an error, since it does not hear of promises. */
export function throwToPage(failure: unknown): void {
  setTimeout(() => {
    throw failure;
  });
}
