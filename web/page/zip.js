// ZIP archives: written without compression, which all readers support; read with or without it, within limits.

/** The time of every entry: 1980-01-01, so that the same files make the same archive. */
const TIME = 0x00210000;
const FILE = 0x04034b50, ENTRY = 0x02014b50, END = 0x06054b50;
/** Largest number of files and bytes that are read: enough for a build of many stars. */
const MOST_FILES = 2000, MOST_BYTES = 1 << 28;

let table = null;

function crc32(bytes) {
    table ??= Uint32Array.from({ length: 256 }, (_, byte) => {
        let rest = byte;
        for (let bit = 0; bit < 8; bit++) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
        return rest;
    });
    let rest = 0xffffffff;
    for (const byte of bytes) rest = table[(rest ^ byte) & 255] ^ (rest >>> 8);
    return (rest ^ 0xffffffff) >>> 0;
}

/** Numbers as little-endian bytes; the number of bytes is beside each. */
function fields(list) {
    const bytes = new Uint8Array(list.reduce((sum, [, size]) => sum + size, 0));
    let at = 0;
    for (const [number, size] of list) {
        for (let i = 0; i < size; i++) bytes[at++] = (number / 2 ** (8 * i)) & 255;
    }
    return bytes;
}

/** The archive of files [{ name, bytes }] in the directory `folder`. */
export function zipped(folder, files) {
    const parts = [], entries = [];
    let at = 0;
    for (const { name, bytes } of files) {
        const path = new TextEncoder().encode(`${folder}/${name}`);
        // Version 2.0, names in UTF-8, stored.
        const common = [[20, 2], [0x0800, 2], [0, 2], [TIME, 4], [crc32(bytes), 4], [bytes.length, 4], [bytes.length, 4], [path.length, 2], [0, 2]];
        const head = fields([[FILE, 4], ...common]);
        parts.push(head, path, bytes);
        entries.push(fields([[ENTRY, 4], [20, 2], ...common, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]]), path);
        at += head.length + path.length + bytes.length;
    }
    const size = entries.reduce((sum, part) => sum + part.length, 0);
    const end = fields([[END, 4], [0, 2], [0, 2], [files.length, 2], [files.length, 2], [size, 4], [at, 4], [0, 2]]);
    return new Blob([...parts, ...entries, end], { type: "application/zip" });
}

/** The content of `stream`, or an error if it has more than `most` bytes. */
export async function drained(stream, most) {
    const reader = stream.getReader(), parts = [];
    let size = 0;
    for (;;) {
        const { done, value } = await reader.read();
        if (done) return new Uint8Array(await new Blob(parts).arrayBuffer());
        size += value.length;
        if (size > most) {
            await reader.cancel();
            throw new Error("it is larger than it may be");
        }
        parts.push(value);
    }
}

/** The files of an archive: [{ name, bytes }], names without directories. */
export async function unzipped(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    let end = bytes.length - 22;
    while (end >= 0 && view.getUint32(end, true) !== END) end--;
    if (end < 0) throw new Error("this is not a ZIP archive");
    const count = view.getUint16(end + 10, true);
    if (count > MOST_FILES) throw new Error(`the archive has more than ${MOST_FILES} files`);
    const files = [];
    let at = view.getUint32(end + 16, true), room = MOST_BYTES;
    for (let i = 0; i < count; i++) {
        if (view.getUint32(at, true) !== ENTRY) throw new Error("the archive is damaged");
        const [method, size, length, extra, comment, local] = [
            view.getUint16(at + 10, true), view.getUint32(at + 20, true), view.getUint16(at + 28, true),
            view.getUint16(at + 30, true), view.getUint16(at + 32, true), view.getUint32(at + 42, true),
        ];
        const path = new TextDecoder().decode(bytes.subarray(at + 46, at + 46 + length));
        at += 46 + length + extra + comment;
        if (path.endsWith("/")) continue;
        const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
        const packed = bytes.slice(start, start + size);
        if (method !== 0 && method !== 8) throw new Error(`${path} is packed in a way that is not read here`);
        const inflated = () => drained(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw")), room);
        const own = method === 0 ? packed : await inflated();
        room -= own.length;
        if (room < 0) throw new Error("the archive is larger than it may be");
        files.push({ name: path.split("/").pop(), bytes: own });
    }
    return files;
}
