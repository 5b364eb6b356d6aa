"""Orders the functions of a WebAssembly program so that functions with similar code are neighbours: brotli packs it 4 % smaller.

Compilers make many functions from one generic one, and write them apart. An order changes nothing that a program does: `reordered` moves
bodies with their types, and renumbers functions where calls, tables and exports name them. It knows the sections and instructions that
the compiler writes today, and ends with a message at any other.
"""
import sys

# Kinds of sections: https://webassembly.github.io/spec/core/binary/modules.html
CUSTOM, IMPORTS, FUNCTIONS, EXPORTS, START, ELEMENTS, CODE = 0, 2, 3, 7, 8, 9, 10
# Instructions, and how many LEB128 numbers follow each: https://webassembly.github.io/spec/core/binary/instructions.html
CALL, REF_FUNC, BR_TABLE, SELECT_TYPES, F32_CONST, F64_CONST, PREFIX = 0x10, 0xD2, 0x0E, 0x1C, 0x43, 0x44, 0xFC
OPERANDS = {code: 0 for code in [0x00, 0x01, 0x05, 0x0B, 0x0F, 0x1A, 0x1B, 0xD1, *range(0x45, 0xC5)]}
OPERANDS |= {code: 1 for code in [0x02, 0x03, 0x04, 0x0C, 0x0D, *range(0x20, 0x27), 0x3F, 0x40, 0x41, 0x42, 0xD0]}
OPERANDS |= {code: 2 for code in [0x11, *range(0x28, 0x3F)]}
PREFIXED = {**{code: 0 for code in range(8)}, **{code: 2 for code in (8, 10, 12, 14)}, **{code: 1 for code in (9, 11, 13, 15, 16, 17)}}


def number(data, start):
    """An unsigned LEB128 number that starts there, and where it ends."""
    value, shift, end = 0, 0, start
    while True:
        value |= (data[end] & 127) << shift
        shift += 7
        end += 1
        if data[end - 1] < 128:
            return value, end


def leb(value):
    """An unsigned number as LEB128, in as few bytes as there can be."""
    return bytes([value & 127 | 128]) + leb(value >> 7) if value > 127 else bytes([value])


def end_of(data, start, numbers=1):
    """Where the last of so many LEB128 numbers ends."""
    for _ in range(numbers):
        while data[start] > 127:
            start += 1
        start += 1
    return start


def sections(program):
    """Kind and content of each section."""
    start = 8
    while start < len(program):
        size, content = number(program, start + 1)
        yield program[start], program[content : content + size]
        start = content + size


def imported_functions(content):
    """How many functions the program imports: their numbers come first. It imports nothing else."""
    count, place = number(content, 0)
    for _ in range(count):
        for _ in ("module", "name"):
            size, place = number(content, place)
            place += size
        if content[place] != 0:
            sys.exit("the program imports more than functions")
        place = end_of(content, place + 1)
    return count


def operand_places(code, start, end):
    """Where the instructions of a body name functions: start and end of each number."""
    groups, place = number(code, start)
    place = end_of(code, place, 2 * groups)  # locals: how many, and of which type
    while place < end:
        instruction, place = code[place], place + 1
        if instruction in (CALL, REF_FUNC):
            yield place, end_of(code, place)
            place = end_of(code, place)
        elif instruction in OPERANDS:
            place = end_of(code, place, OPERANDS[instruction])
        elif instruction in (F32_CONST, F64_CONST):
            place += 4 if instruction == F32_CONST else 8
        elif instruction in (BR_TABLE, SELECT_TYPES):
            targets, place = number(code, place)
            place = end_of(code, place, targets + (instruction == BR_TABLE))
        elif instruction == PREFIX and number(code, place)[0] in PREFIXED:
            operation, place = number(code, place)
            place = end_of(code, place, PREFIXED[operation])
        else:
            sys.exit(f"web/function_order.py does not know the instruction {instruction:#x}: add it to OPERANDS")
    if place != end:
        sys.exit("a function does not end with its last instruction")


def bodies(code):
    """The body of each function: code between the numbers of functions, and these numbers."""
    count, place = number(code, 0)
    for _ in range(count):
        size, place = number(code, place)
        pieces, functions, end = [], [], place + size
        for start, behind in operand_places(code, place, end):
            pieces.append(code[place:start])
            functions.append(number(code, start)[0])
            place = behind
        yield [*pieces, code[place:end]], functions
        place = end


def with_numbers(pieces, functions, renumbered):
    """Pieces with the new number of a function between each two."""
    return b"".join(piece + leb(renumbered[function]) for piece, function in zip(pieces, functions)) + pieces[-1]


def exports(content, renumbered):
    """The section of exports with new numbers of functions."""
    count, place = number(content, 0)
    text = leb(count)
    for _ in range(count):
        size, name = number(content, place)
        kind = name + size
        exported, end = number(content, kind + 1)
        text += content[place : kind + 1] + leb(renumbered[exported] if content[kind] == 0 else exported)
        place = end
    return text


def elements(content, renumbered):
    """The section of a table's functions with their new numbers. It has active segments of the first table, which begin at a constant."""
    count, place = number(content, 0)
    text = leb(count)
    for _ in range(count):
        functions = end_of(content, place + 2) + 1
        if content[place] != 0 or content[place + 1] != 0x41 or content[functions - 1] != 0x0B:
            sys.exit("the program has a table of an unknown kind")
        size, end = number(content, functions)
        text += content[place:functions] + leb(size)
        for _ in range(size):
            function, end = number(content, end)
            text += leb(renumbered[function])
        place = end
    return text


def reordered(program):
    """The program with its functions in the order of their types, then of their code without the numbers of functions."""
    content = dict(sections(program))
    if CUSTOM in content or START in content:
        sys.exit("the program has names or starts by itself: it must be stripped, and have no start")
    count, place = number(content[FUNCTIONS], 0)
    types = []
    for _ in range(count):
        kind, place = number(content[FUNCTIONS], place)
        types.append(kind)
    functions = list(bodies(content[CODE]))
    order = sorted(range(count), key=lambda index: (types[index], bytes([CALL]).join(functions[index][0])))
    imported = imported_functions(content[IMPORTS])
    renumbered = list(range(imported + count))
    for place, index in enumerate(order):
        renumbered[imported + index] = imported + place
    ordered = [with_numbers(*functions[index], renumbered) for index in order]
    content[FUNCTIONS] = leb(count) + b"".join(leb(types[index]) for index in order)
    content[CODE] = leb(count) + b"".join(leb(len(body)) + body for body in ordered)
    content[EXPORTS] = exports(content[EXPORTS], renumbered)
    content[ELEMENTS] = elements(content[ELEMENTS], renumbered)
    return program[:8] + b"".join(bytes([kind]) + leb(len(content[kind])) + content[kind] for kind, _ in sections(program))
