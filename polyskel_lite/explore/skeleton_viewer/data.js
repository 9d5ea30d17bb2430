// What Python packed, as arrays again.

const TYPES = {
  i2: Int16Array, u1: Uint8Array, u2: Uint16Array, u4: Uint32Array, i4: Int32Array, f4: Float32Array, f8: Float64Array,
};

export async function unpacked(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

export function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Read one array; numbers stored as differences are summed up again. */
export function read(buffer, ref) {
  if (!ref) return null;
  const array = new TYPES[ref.type](buffer, ref.at, ref.size).slice();
  if (ref.delta) for (let i = ref.delta; i < array.length; i++) array[i] += array[i - ref.delta];
  return array;
}

/** Positions as floats, three a point, in the units of the data; far ones are stored apart, unrounded. */
export function positions(buffer, ref, dimension) {
  const whole = read(buffer, ref.grid);
  const n = whole.length / dimension;
  const out = new Float32Array(3 * n);
  const size = ref.high.map((h, k) => h - ref.low[k]);
  for (let i = 0; i < n; i++) {
    for (let k = 0; k < dimension; k++) out[3 * i + k] = ref.low[k] + (size[k] * whole[dimension * i + k]) / 65535;
  }
  const far = read(buffer, ref.far);
  const places = read(buffer, ref.far_places);
  if (far) far.forEach((i, j) => { for (let k = 0; k < dimension; k++) out[3 * i + k] = places[dimension * j + k]; });
  return out;
}
