# local stand-in until the core compiles (never committed)
import re

__version__ = "0.1.0"
_src = open("/work/main/crates/antumbra/src/settings.rs").read()
_ch = {m[0]: re.findall(r'"([^"]+)"', m[1]) for m in re.findall(r"choices!\((\w+): ([^;]*)\);", _src)}
_mv = {
    "u32": "N",
    "f32": "X",
    "f64": "X",
    "bool": "NAME",
    "String": "NAME",
    "Vec<String>": "NAME",
    "[f64; 3]": "X,Y,Z",
    "[u32; 2]": "WxH",
    "[u32; 4]": "X,Y,W,H",
    "SelfIntersection": "safe|none|epsilon:E",
    "Planes": "LIST",
}


def settings():
    body = _src[_src.index('settings! {\n    "Light"') :]
    body = body[: body.index("\n}\n")]
    out = []
    group = ""
    for line in body.splitlines():
        if m := re.match(r'\s+"(\w+)" \{', line):
            group = m[1]
        if m := re.match(r"\s+/// (.*)", line):
            help = m[1]
        if m := re.match(r"\s+(\w+): ([^=]+) = ([^,;]+)", line):
            ty = re.sub(r"Option<(.*)>", r"\1", m[2].strip())
            ch = _ch.get(ty, [])
            d = m[3]
            if ty == "bool":
                ch = ["on", "off"]
                d = "on" if d == "true" else "off"
            if "::" in d:
                d = re.sub(r"(?<!^)([A-Z])", r"-\1", d.split("::")[1]).lower()
            d = {"None": "", "f32::-i-n-f-i-n-i-t-y": "inf", "new()": "", "n-o-n-e": ""}.get(d, d)
            if "INFIN" in m[3]:
                d = "inf"
            if ty == "Planes" or ty == "Vec<String>" or m[3] == "None":
                d = ""
            out.append((m[1], group, _mv.get(ty, "NAME"), tuple(ch), d, help, ty == "Vec<String>"))
    return out


def check_settings(words):
    pass


def nearest(t, known):
    import difflib

    r = difflib.get_close_matches(t, known, 1)
    return r[0] if r else None
