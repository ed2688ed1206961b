// summary.toml as the run wrote it: lines "key = value # comment" in sections.

export interface Entry {
  key: string;
  value: string;
  comment: string;
}

export interface Section {
  name: string;
  entries: Entry[];
}

export function sectionsOf(toml: string): Section[] {
  const sections: Section[] = [];
  for (const line of toml.split("\n")) {
    const title = /^\[(.+)\]$/.exec(line);
    if (title) sections.push({ name: title[1], entries: [] });
    const entry = /^(\S+)\s*= ("(?:[^"\\]|\\.)*"|\S+)\s*(?:# (.*))?$/.exec(line);
    if (entry) sections.at(-1)?.entries.push({ key: entry[1], value: entry[2], comment: entry[3] ?? "" });
  }
  return sections;
}

/** The entries "effect.NAME.KEY" as a row for each name. */
export function effectsOf(sections: Section[]): Map<string, Map<string, string>> {
  const effects = new Map<string, Map<string, string>>();
  for (const { key, value } of sections.flatMap((section) => section.entries)) {
    const [kind, name, column] = key.split(".");
    if (kind !== "effect") continue;
    if (!effects.has(name)) effects.set(name, new Map());
    effects.get(name)!.set(column, value);
  }
  return effects;
}
