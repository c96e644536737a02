// Workers, each with its own copy of the film in memory.

/** Looks that a thread is taken to have: fewer than it keeps. */
const MOST_KNOWN = 90;

/** One worker: tasks are done in the order in which they are asked. */
class Thread {
  constructor(module) {
    this.waiting = new Map();
    this.next = 1;
    /** Looks that it is known to have, by their key. */
    this.looks = new Set();
    this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.worker.onmessage = ({ data }) => this.answered(data);
    this.worker.onerror = (event) => {
      for (const { reject } of this.waiting.values()) reject(new Error(event.message || "a worker of this page cannot be started"));
      this.waiting.clear();
    };
    this.ready = this.ask("start", { module });
    this.ready.catch(() => {});
  }

  ask(task, args = {}, transfer = [], progress = undefined) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject, progress });
      this.worker.postMessage({ id, task, ...args }, transfer);
    });
  }

  answered({ id, done, value, error, trapped }) {
    const asked = this.waiting.get(id);
    if (!asked) return;
    if (done !== undefined) {
      asked.progress?.(done);
      return;
    }
    this.waiting.delete(id);
    if (trapped) this.looks.clear();
    if (error === undefined) asked.resolve(value);
    else asked.reject(new Error(error));
  }

  /** Develops pixels that were kept; the look's form goes along the first time. */
  develop(look, args) {
    return this.withLook("develop", look, args);
  }

  /** A task that needs a look with its film: `all` its keys. */
  withFilm(task, look, all, args, transfer, progress) {
    return this.ask(task, { all, packed: look.packed, ...args }, transfer, progress);
  }

  withLook(task, look, args, transfer, progress) {
    const known = this.looks.delete(look.key);
    this.looks.add(look.key);
    if (this.looks.size > MOST_KNOWN) this.looks.delete(this.looks.values().next().value);
    const sent = { key: look.key, packed: known ? undefined : look.packed };
    const answer = this.ask(task, { ...sent, ...args }, transfer, progress);
    answer.catch(() => this.looks.delete(look.key));
    return answer;
  }

  get load() {
    return this.waiting.size;
  }

  end() {
    this.worker.terminate();
    for (const { reject } of this.waiting.values()) reject(new Cancelled());
    this.waiting.clear();
  }
}

/** What a task ends with when it was cancelled. */
export class Cancelled extends Error {}

/**
 * Threads that draw, threads that fit looks, one for the look that is shown, one that reads pictures, runs effects and says where colours come
 * from, one for what takes long, and a spare for when that is cancelled.
 */
export class Pool {
  constructor(module) {
    this.module = module;
    const count = Math.min(Math.max(navigator.hardwareConcurrency || 2, 2), 8);
    const threads = (count) => Array.from({ length: count }, () => new Thread(module));
    this.threads = threads(count);
    this.fitters = threads(count >> 1);
    this.live = new Thread(module);
    this.reader = new Thread(module);
    this.long = new Thread(module);
    this.spare = new Thread(module);
    this.wanted = [];
  }

  get ready() {
    return Promise.all([...this.threads, ...this.fitters, this.live, this.reader, this.long, this.spare].map((thread) => thread.ready));
  }

  /** The drawing thread with the least to do. */
  get idlest() {
    return this.threads.reduce((least, thread) => (thread.load < least.load ? thread : least));
  }

  /** The packed form of a look, once its turn comes, those that can be seen first: `still` says whether it is wanted when its turn comes. */
  fit(request, still) {
    return new Promise((resolve, reject) => {
      this.wanted.push({ request, still, resolve, reject });
      this.more();
    });
  }

  more() {
    for (const thread of this.fitters) {
      while (thread.load === 0 && this.wanted.length > 0) {
        const { request, still, resolve, reject } = this.wanted.shift();
        if (still()) thread.ask("fit", request).then(resolve, reject).finally(() => this.more());
        else reject(new Cancelled());
      }
    }
  }

  /** Ends what takes long; the next such task has a thread of its own. */
  cancel() {
    this.long.end();
    this.long = this.spare;
    this.spare = new Thread(this.module);
  }
}
