// Asks the module, away from the page: it answers one question after another, and long analyses a record at a time.
"use strict";
let exports = null;
let bytesOfModule = null;
let bytesOfStripes = null;
let stopped = false;

const unzip = async (bytes) =>
  new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());

async function start() {
  exports = (await WebAssembly.instantiate(bytesOfModule, {})).instance.exports;
  return ask({ ask: "stripes" }, bytesOfStripes);
}

function ask(question, file) {
  const text = new TextEncoder().encode(JSON.stringify(question));
  const extra = file ? file.length : 0;
  const place = exports.uplift_allocate(text.length + extra);
  const room = new Uint8Array(exports.memory.buffer, place, text.length + extra);
  room.set(text);
  if (file) room.set(file, text.length);
  const length = exports.uplift_answer(extra);
  const reply = new Uint8Array(exports.memory.buffer, exports.uplift_reply(), length);
  const { answer, error } = JSON.parse(new TextDecoder().decode(reply));
  if (error !== undefined) throw new Error(error);
  return answer;
}

// lets messages in between two records
const breath = () => new Promise((resolve) => {
  const channel = new MessageChannel();
  channel.port1.onmessage = resolve;
  channel.port2.postMessage(0);
});

async function analyse(question, progress) {
  stopped = false;
  let state = ask(question);
  while (state.finished === undefined) {
    progress(state);
    await breath();
    if (stopped) {
      ask({ ask: "stop" });
      throw new Error("stopped");
    }
    state = ask({ ask: "step" });
  }
  return state.finished;
}

onmessage = async ({ data: { id, kind, question, file, module, stripes } }) => {
  if (kind === "stop") {
    stopped = true;
    return;
  }
  try {
    let answer;
    if (kind === "start") {
      [bytesOfModule, bytesOfStripes] = await Promise.all([unzip(module), unzip(stripes)]);
      answer = await start();
    } else if (kind === "embedded") {
      answer = ask({ ask: "stripes" }, bytesOfStripes);
    } else if (kind === "analyse") {
      answer = await analyse(question, (state) => postMessage({ id, progress: state }));
    } else {
      answer = ask(question, file);
    }
    postMessage({ id, answer });
  } catch (error) {
    const isBug = error instanceof WebAssembly.RuntimeError;
    // what trapped is in no known state: another one takes its place, with the embedded stripes
    const about = isBug ? await start() : undefined;
    postMessage({ id, error: isBug ? `a bug of this page: ${error.message}` : error.message, isBug, about });
  }
};
