// What a driver says of a text, with the places of the scene's files.

// A line of the scene's text, from 1, as "file:line".
export const placeOf = (plan, line) => {
    const [start, file, first] = plan.origins.findLast(origin => origin[0] <= line);
    return `${plan.files[file]}:${first + line - start}`;
};

// `added`: lines before the scene's own in the text that the driver saw.
export const explain = (plan, pass, log, added) => {
    const lines = (log.match(/[^\n\0]+/g) ?? []).map(line => {
        const [, kind, number, text] = line.match(/^(ERROR|WARNING): \d+:(\d+): (.*)/) ?? [];
        return number > added ? `${placeOf(plan, number - added)}: ${kind.toLowerCase()}: ${text}` : `${plan.files[0]}: ${line}`;
    });
    return `Pass ${pass.name} does not compile here.\n${lines.join("\n") || "The driver does not say why."}`;
};
