// A blind test: X is A or B at random, the listener says which.
class Abx {
  constructor(trials = 10, random = Math.random) {
    Object.assign(this, { trials, random, done: 0, right: 0 });
    this.next();
  }

  next() {
    this.x = this.random() < 0.5 ? "A" : "B";
  }

  answer(guess) {
    if (this.finished) return;
    this.done += 1;
    if (guess === this.x) this.right += 1;
    this.next();
  }

  get finished() {
    return this.done >= this.trials;
  }

  // Probability of as many right answers, or more, by guessing.
  get chance() {
    let sum = 0, ways = 1;
    for (let k = this.done; k >= this.right; k--) {
      sum += ways;
      ways = (ways * k) / (this.done - k + 1);
    }
    return sum / 2 ** this.done;
  }

  get score() {
    const by = this.done ? `; by guessing as many or more in ${(100 * this.chance).toFixed(1)} %` : "";
    return `${this.right} of ${this.done} right, ${this.trials} in all${by}`;
  }
}
