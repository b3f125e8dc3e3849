// Arrays of numbers that the data hold as base64 texts, little-endian.

function buffer_of(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

const f64_of = (text) => new Float64Array(buffer_of(text));
const f32_of = (text) => new Float32Array(buffer_of(text));
const u32_of = (text) => new Uint32Array(buffer_of(text));
const u16_of = (text) => new Uint16Array(buffer_of(text));
