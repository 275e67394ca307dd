// The worker's side of the protocol (adapters/worker/README.md) for engines that JavaScript drives.
//
// serve(engine) answers requests with the methods of `engine`:
//     capabilities() → object
//     load(scene, arrays, settings) → object          throws Unsupported
//     advance(time) → number
//     snapshot(contacts) → [object, {name: [type, typed array or list]}]
//     stats() → object
// Objects are the protocol's JSON; arrays go under the protocol's names.

import fs from 'node:fs';

const PROTOCOL = 1;
const TYPES = {f64: Float64Array, i32: Int32Array, u8: Uint8Array};  // this machine's order, little-endian

/// The engine cannot do what the scene calls for; the text names the first such thing.
export class Unsupported extends Error {}

/// The arrays of an array file by name.
function readArrays(path, entries) {
  const data = fs.readFileSync(path);
  const arrays = {};
  for (const {name, type, count, offset} of entries) {
    const Type = TYPES[type];
    arrays[name] = new Type(count);
    new Uint8Array(arrays[name].buffer).set(data.subarray(offset, offset + count * Type.BYTES_PER_ELEMENT));
  }
  return arrays;
}

/// Writes an array file. Returns the list that describes it.
function writeArrays(path, arrays) {
  const entries = [], pieces = [];
  let offset = 0;
  for (const [name, [type, values]] of Object.entries(arrays)) {
    const padding = -offset & 7, array = TYPES[type].from(values);
    pieces.push(Buffer.alloc(padding), Buffer.from(array.buffer));
    entries.push({name, type, count: array.length, offset: offset + padding});
    offset += padding + array.byteLength;
  }
  // Over what is there, and not cut off first: the harness names one file again and again.
  const file = fs.openSync(path, fs.constants.O_WRONLY | fs.constants.O_CREAT);
  fs.writeFileSync(file, Buffer.concat(pieces));
  fs.closeSync(file);
  return entries;
}

function answer(engine, request) {
  switch (request.request) {
    case 'hello': return {protocol: PROTOCOL, capabilities: engine.capabilities(), writes_over: true};
    case 'load': return {realised: engine.load(request.scene, readArrays(request.file, request.arrays), request.settings)};
    case 'advance': return {time: engine.advance(request.time)};
    case 'snapshot': {
      const [snapshot, arrays] = engine.snapshot(request.contacts);
      return {snapshot, arrays: writeArrays(request.file, arrays)};
    }
    case 'stats': return {stats: engine.stats()};
    case 'quit': return {};
  }
  throw new Error(`no request '${request.request}'`);
}

/// Lines of a descriptor as they come; ends with it.
function* lines(descriptor) {
  const block = Buffer.alloc(1 << 16);
  let rest = Buffer.alloc(0);
  for (let size; (size = fs.readSync(descriptor, block, 0, block.length, null)) > 0;) {
    rest = Buffer.concat([rest, block.subarray(0, size)]);
    for (let end; (end = rest.indexOf(10)) >= 0; rest = rest.subarray(end + 1)) yield rest.toString('utf8', 0, end);
  }
}

/// Answers requests until "quit" or until they end.
export function serve(engine) {
  for (const line of lines(3)) {
    const request = JSON.parse(line);
    let reply;
    try {
      reply = {ok: true, ...answer(engine, request)};
    } catch (error) {
      const kind = error instanceof Unsupported ? 'unsupported' : 'failed';
      reply = {ok: false, kind, what: String(error.message).replace(/\s+/g, ' ')};
    }
    const bytes = Buffer.from(JSON.stringify(reply) + '\n');
    for (let done = 0; done < bytes.length;) done += fs.writeSync(4, bytes, done);
    if (request.request === 'quit') return;
  }
}
