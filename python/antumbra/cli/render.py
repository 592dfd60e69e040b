"""`antumbra render`: a picture of a scene."""

from antumbra.cli._command import GROUPS, Option, Verb

ORDER = 1


def run(**kw):
    """Render SCENE to an EXR or PNG picture."""
    print(kw)


VERB = Verb(
    "render",
    run,
    arguments=[("SCENE", True)],
    groups=GROUPS,
    examples=[
        ("antumbra render cornell-box", "a built-in scene"),
        ("antumbra render room.glb --viewing-rays 64 -o room.png", ""),
        ("antumbra render pillars --estimator area --shadow-rays 9 -D light-size=0.5", ""),
    ],
    options=[Option("-o", group="Files", metavar="FILE", help="the picture, .exr or .png [NAME.exr]")],
)
