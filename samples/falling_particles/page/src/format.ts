// Numbers as people read them.

const prefixes: [number, string][] = [
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
  [1e-9, "n"],
];

/** With an SI prefix and three digits: 0.00421, "m" is "4.21 mm". */
export function withUnit(value: number, unit: string): string {
  const size = Math.abs(value);
  if (size < 1e-12) return `0 ${unit}`;
  const [factor, prefix] = prefixes.find(([least]) => size >= least * 0.9995) ?? prefixes[prefixes.length - 1];
  return `${digits(value / factor)} ${prefix}${unit}`;
}

export function digits(value: number): string {
  return String(Number(value.toPrecision(3)));
}

export function seconds(time: number, duration: number): string {
  const decimals = duration < 0.1 ? 4 : duration < 10 ? 2 : 1;
  return time.toFixed(decimals);
}
