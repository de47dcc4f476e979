"""The Python package's type stubs and help, for `generate`: from tables.json, the comments of the public headers, the lines
`bind<ik::Options>(root, "Options")` in python/*.cpp, and python/stubs/*.pyi, which have what no table says. The first
paragraph of a docstring there becomes the help of the function in Python."""
import ast
import keyword
import re
import textwrap

from headers import BINDINGS, TABLES, enumerators, find_body, member_help, row_facts, stop

DOOR = BINDINGS / "python"
WIDTH = 120
TYPES = {"flag": "bool", "i32": "int", "u32": "int", "u64": "int", "size": "int", "index": "int", "f32": "float",
         "f64": "float", "text": "str"}
WRITTEN = "Written by core/bindings/generate"


def bound():
    """(module, C++ name, Python name, spans) of each struct that a source binds; "" is the package itself."""
    for path in sorted(DOOR.glob("*.cpp")):
        for cpp, room, name, more in re.findall(r'\bbind<([\w:<>]+)>\((\w+), "(\w+)"(.*?)\);', path.read_text(), re.S):
            yield "" if room == "root" else room, cpp, name, re.findall(r'span_of<[^>]*>\("(\w+)"\)', more)


def table_of(cpp):
    return TABLES.get(cpp) or TABLES.get(f"{cpp[:-2]}<double>" if cpp.endswith("<>") else cpp) or \
        stop(f"{cpp} has no table in tables.json")


class Names:
    """The Python names of C++ structs and enumerations, as (module, name)."""
    def __init__(self):
        self.structs, self.spans, self.enums = {}, {}, {}
        for module, cpp, name, spans in bound():
            cpp = table_of(cpp)["struct"]
            self.structs[cpp], self.spans[cpp] = (module, name), spans
        for path in sorted(DOOR.glob("*.cpp")):
            for room, name, cpp in re.findall(r'bind_enum\((\w+), "(\w+)", detail::type_name<([\w:]+)>\(\)', path.read_text()):
                self.enums[cpp] = ("" if room == "root" else room, name, None)
        for cpp, (module, _) in self.structs.items():
            for row in TABLES[cpp]["rows"]:
                if "enum" in row and (row["enum"] not in self.enums or self.enums[row["enum"]][2] is None):
                    place = self.enums.get(row["enum"], (module, row["enum"].split("::")[-1]))
                    self.enums[row["enum"]] = (*place[:2], row["choices"])

    def hidden(self, cpp, row):
        """A list that the struct does not own, and that Python does not fill: results go to NumPy arrays."""
        if row["type"] == "other":
            return True
        if not row.get("list") or row["name"] in self.spans[cpp]:
            return False
        _, body = find_body("struct", cpp)
        return any(re.search(rf"std::span<.*>\s+{row.get('member', row['name'])}\b", line) for line in body)

    def rows(self, cpp):
        return [row for row in TABLES[cpp]["rows"] if not self.hidden(cpp, row)]


NAMES = Names()


def qualified(place, module):
    return place[1] if place[0] == module else f"{place[0] or 'tendril'}.{place[1]}"


def type_of(row, module):
    kind = row["type"]
    if kind == "choice":
        said = f"{qualified(NAMES.enums[row['enum']], module)} | str"
    elif kind == "struct":
        place = NAMES.structs.get(row["struct"]) or stop(f"python: {row['struct']} is not bound")
        said = qualified(place, module)
    elif kind == "kind":
        said = "Struct" if module == "" else "tendril.Struct"
    else:
        said = TYPES.get(kind, "Sequence[float]")
    if row.get("list"):
        said = f"Sequence[{said}]"
    return said + (" | None" if row.get("optional") else "")


def comment_of(row, said, output):
    """Help, then unit, range and default: "Pole target [m, -1e9 to 1e9, default None]."."""
    facts, said = row_facts(row, said.replace("::", "."), output)
    facts = [f"default {row['default'] == 1}" if row["type"] == "flag" and fact.startswith("default") else
             "default None" if fact == "unset" else fact for fact in facts if fact != "0 or 1"]
    said = said or row["name"].replace("_", " ")
    said = said[:1].upper() + said[1:]
    return said.rstrip(".") + f" [{', '.join(facts)}]." if facts else sentence(said)


DOCS = {}  # of structs whose header says nothing that Python can show, from stubs/*.pyi


def struct_help(cpp):
    try:
        said, members = member_help(cpp)
    except SystemExit:
        said, members = "", {}
    return DOCS.get(NAMES.structs[cpp], said).replace("::", "."), members


def read_docs():
    for stem in modules():
        for node in ast.parse((DOOR / "stubs" / f"{stem}.pyi").read_text()).body:
            place = ("" if stem == "tendril" else stem, getattr(node, "name", ""))
            if isinstance(node, ast.ClassDef) and place in NAMES.structs.values() and ast.get_docstring(node):
                DOCS[place] = ast.get_docstring(node).replace("\n", " ")


def is_output(cpp):
    return bool(re.search(r"(Report|Result|State|Memory|Summary|Measures)(<.*>)?$", cpp))


def member_texts(cpp):
    """The help of each member; one line of the header that declares several says it once."""
    _, said = struct_help(cpp)
    for row in NAMES.rows(cpp):
        yield row, comment_of(row, said.get(row.get("member", row["name"]), ""), is_output(cpp))


def sentence(text):
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "?", ".)")) else ".") if text else ""


def documented(text, indent):
    """A docstring."""
    space = " " * indent
    lines = textwrap.wrap(text, WIDTH - indent - 6) or [""]
    return [f'{space}"""{lines[0]}' + ('"""' if len(lines) == 1 else "")] + \
        [space + line + ('"""' if at + 2 == len(lines) else "") for at, line in enumerate(lines[1:])]


def enum_text(cpp):
    _, name, choices = NAMES.enums[cpp]
    nested = cpp.count("::") > 1
    said, values = ("", []) if nested else enumerators(cpp)
    texts = [each for _, each in values]
    if choices is None:
        choices = [re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", value).lower() for value, _ in values]
    yield f"class {name}(str, Enum):"
    yield from documented(sentence(said) or f"Choices of `{name}`.", 4)
    for at, each in enumerate(choices):
        member = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", each).upper()
        yield f"    {member} = {each!r}".replace("'", '"')
        if at < len(texts) and texts[at]:
            yield from documented(sentence(texts[at]), 4)
    yield ""
    yield ""


def name_of(row):
    """`from_` for a row whose name Python keeps for itself."""
    return row["name"] + "_" * keyword.iskeyword(row["name"])


def keywords(cpp, module):
    for row in NAMES.rows(cpp):
        yield f"{name_of(row)}: {type_of(row, module)} = ..."


def wrapped(code, parts, end):
    """A signature on one line, or a parameter after the other on as many as it takes."""
    line = code + ", ".join(parts) + end
    if len(line) <= WIDTH:
        return [line]
    indent = " " * (len(code) - len(code.lstrip()) + 8)
    text = (", ".join(parts) + end).replace(" ", "\0").replace(",\0", ", ")
    lines = textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent, break_long_words=False,
                          break_on_hyphens=False)
    return [code.rstrip(), *(line.replace("\0", " ") for line in lines)]


def struct_text(cpp):
    module, name = NAMES.structs[cpp]
    base = "Struct" if module == "" else "tendril.Struct"
    said, _ = struct_help(cpp)
    yield f"class {name}({base}):"
    yield from documented(sentence(said) or f"{name}.", 4)
    for row, text in member_texts(cpp):
        yield f"    {name_of(row)}: {type_of(row, module)}"
        yield from documented(text, 4)
    yield from wrapped("    def __init__(", ["self", "*", *keywords(cpp, module)], ") -> None: ...")
    yield from EXTRA.get((module, name), [])
    yield ""
    yield ""


EXTRA = {}  # what stubs/*.pyi adds to a struct


def expand(text, module):
    """`**fields: Options` -> a keyword for each member."""
    def keywords_of(found):
        cpp = next((cpp for cpp, place in NAMES.structs.items() if place == (module, found[1])), None) or \
            stop(f"python/stubs: {module} has no {found[1]}")
        return ", ".join(keywords(cpp, module))
    out = []
    for line in text.splitlines():
        if re.search(r"\*\*fields: (\w+)", line):
            head = re.sub(r"\*\*fields: (\w+)", keywords_of, line)
            code, _, rest = head.partition("(")
            depth, parts, part = 0, [], ""
            body, _, end = rest.rpartition(") ->")
            for letter in body:
                depth += letter in "[(" 
                depth -= letter in "])"
                if letter == "," and depth == 0:
                    parts.append(part.strip())
                    part = ""
                else:
                    part += letter
            parts.append(part.strip())
            out += wrapped(code + "(", parts, ") ->" + end)
        else:
            out.append(line)
    return "\n".join(out)


def modules():
    return sorted(path.stem for path in (DOOR / "stubs").glob("*.pyi"))


def stub(stem):
    module = "" if stem == "tendril" else stem
    template = (DOOR / "stubs" / f"{stem}.pyi").read_text()
    tree = ast.parse(template)
    lines = template.splitlines()
    structs = {name for owner, name in NAMES.structs.values() if owner == module}
    cut = []
    for node in tree.body:  # functions that are added to a struct
        if isinstance(node, ast.ClassDef) and node.name in structs:
            first = node.body[0].end_lineno if ast.get_docstring(node) else node.lineno
            EXTRA[module, node.name] = expand("\n".join(lines[first:node.end_lineno]), module).splitlines()
            cut.append((node.lineno - 1, node.end_lineno))
    for first, last in reversed(cut):
        del lines[first:last]
    body = []
    for cpp, (owner, *_) in NAMES.enums.items():
        if owner == module:
            body += enum_text(cpp)
    for cpp, (owner, _) in NAMES.structs.items():
        if owner == module:
            body += struct_text(cpp)
    text = expand("\n".join(lines), module)
    return f"# {WRITTEN} from stubs/{stem}.pyi and the library's tables. Edit those.\n" + \
        re.sub(r"\n{3,}", "\n\n\n", text.replace("# structs", "\n".join(body).rstrip())).rstrip() + "\n"


def signature_of(node):
    """As inspect.signature() reads it."""
    for each in ast.walk(node.args):
        if isinstance(each, ast.arg):
            each.annotation = None
    text = ast.unparse(node.args).replace("=...", "=None")
    return re.sub(r"^(self|cls)\b", r"$\1", text)


def helps():
    """(name, text) of every class, member and function."""
    for cpp in NAMES.structs:
        said, _ = struct_help(cpp)
        yield cpp, sentence(said) or f"{NAMES.structs[cpp][1]}."
        for row, text in member_texts(cpp):
            yield f"{cpp}.{row['name']}", text
    for cpp, (_, name, _) in NAMES.enums.items():
        said = "" if cpp.count("::") > 1 else enumerators(cpp)[0]
        yield cpp, sentence(said) or f"Choices of `{name}`."
    for stem in modules():
        prefix = "" if stem == "tendril" else stem + "."
        tree = ast.parse((DOOR / "stubs" / f"{stem}.pyi").read_text())
        yield stem, ast.get_docstring(tree)
        for node in tree.body:
            yield from helps_of(node, prefix)


def helps_of(node, prefix):
    if isinstance(node, ast.ClassDef):
        if said := ast.get_docstring(node):
            yield prefix + node.name, said
        for each in node.body:
            yield from helps_of(each, f"{prefix}{node.name}.")
    elif isinstance(node, ast.FunctionDef):
        said = ast.get_docstring(node) or ""
        if any(isinstance(each, ast.Name) and each.id == "property" for each in node.decorator_list):
            yield prefix + node.name, said
        elif not node.name.startswith("__") or node.name == "__init__":
            yield prefix + node.name, f"{node.name}({signature_of(node)})\n--\n\n{said}"


def c_string(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def help_source():
    out = [f"// {WRITTEN} from the comments of the public headers, tables.json and stubs/*.pyi. Edit those.",
           '#include "help.hpp"', "", "#include <algorithm>", "#include <iterator>", "",
           "namespace tendril::python {", "", "namespace {", "", "struct Help {", "    std::string_view name;",
           "    const char* text;", "};", "constexpr Help helps[] = {"]
    for name, text in sorted(dict(helps()).items()):
        pieces = [text[at:at + 90] for at in range(0, len(text), 90)] or [""]
        out.append(f"    {{{c_string(name)},")
        out += [f"     {c_string(piece)}" for piece in pieces[:-1]] + [f"     {c_string(pieces[-1])}}},"]
    out += ["};", "", "}  // namespace", "", "const char* help(std::string_view name) noexcept {",
            "    const Help* const found = std::lower_bound(std::begin(helps), std::end(helps), name,",
            "        [](const Help& each, std::string_view wanted) { return each.name < wanted; });",
            '    return found != std::end(helps) && found->name == name ? found->text : "";', "}", "",
            "}  // namespace tendril::python"]
    return "\n".join(out) + "\n"


def files():
    read_docs()
    for stem in modules():
        yield DOOR / "tendril" / f"{'__init__' if stem == 'tendril' else stem}.pyi", stub(stem)
    yield DOOR / "help.cpp", help_source()
