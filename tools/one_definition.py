#!/usr/bin/env python3
"""Finds names defined in two files of the same namespace: types, and functions with the same parameter types.

The linker takes one of two such definitions without a word, whichever comes first. Definitions in an anonymous namespace
are a file's own and do not count. Reads the sources' house style: what a namespace holds starts in the first column.

usage: one_definition.py FILE...   exit status 1 where a name is defined twice
"""
import collections
import re
import sys

TYPE = re.compile(r'^(?:template <[^>]*> )?(?:struct|class|union|enum(?: class)?) (?:alignas\(\w+\) )?(\w+)(?!\w|::)[^;]*\{')
FUNCTION = re.compile(r'^(?:template <[^>]*>\s*)?(inline |constexpr |[A-Za-z_:<>,&*\s]+?[\s&*])(\w+)\(([^()]*)\)[^;={}]*\{')
OPEN = re.compile(r'^(?:inline )?namespace ?([\w:]*) ?\{')
CLOSE = re.compile(r'^\} // namespace')


def parameter_types(text):
    """`const Points& positions, int k = 2` as `const Points&, int`: names and defaults do not tell functions apart."""
    types = []
    for parameter in re.sub(r'<[^<>]*>', lambda m: m.group().replace(',', ';'), text).split(','):
        words = parameter.split('=')[0].split()
        types.append(' '.join(words[:-1]) if len(words) > 1 and words[-2] != 'const' else ' '.join(words))
    return ', '.join(types)


def definitions(path):
    """Each (qualified name, line) that the file defines with external linkage."""
    with open(path, encoding='utf-8') as file:
        lines = file.read().split('\n')
    spaces = []
    for number, line in enumerate(lines, 1):
        if opened := OPEN.match(line):
            spaces.append(opened.group(1))
        elif CLOSE.match(line):
            spaces.pop()
        elif '' in spaces or not line or line[0] in ' #/}':
            continue
        else:
            whole = ' '.join(part.strip() for part in lines[number - 1:number + 5])
            if found := TYPE.match(whole):
                yield '::'.join([*spaces, found.group(1)]), number
            elif (found := FUNCTION.match(whole)) and not line.startswith('static ') and found.group(2) != 'main':
                yield f"{'::'.join([*spaces, found.group(2)])}({parameter_types(found.group(3))})", number


def main(paths):
    places = collections.defaultdict(list)
    for path in paths:
        for name, number in definitions(path):
            places[name].append((path, number))
    twice = {name: where for name, where in places.items() if len({path for path, _ in where}) > 1}
    for name, where in sorted(twice.items()):
        print(f"{name} is defined in more than one file: {', '.join(f'{path}:{number}' for path, number in where)}")
    return 1 if twice else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
