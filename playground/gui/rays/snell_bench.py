"""The Snell bench as the user sees it: sliders, the ray to drag, the curve of Fresnel."""

from __future__ import annotations

from dataclasses import replace
from math import asin, copysign, cos, degrees, pi, radians, sin

from imgui_bundle import imgui

from playground.explain.ray_tree import PRIMARY, REFLECTION, REFRACTION, TOTAL
from playground.gui.rays import fresnel_plot
from playground.gui.rays.ray_colours import Rgb, ink
from playground.gui.rays.snell import MEDIA, Bench, angle_at, ends, medium
from playground.gui.widgets import LABELS, Ui, edit

HIGH = 15.0  # of the drawing, in heights of the text
THIN, THICK = 1.0, 5.0  # of a ray that carries nothing, and of one that carries all
HEAD = 8.0
GLASS: Rgb = (0.25, 0.55, 0.85)
FULL = 4.0  # the index at which a medium is drawn in its full colour


def draw(bench: Bench, ui: Ui, theme: str) -> Bench:
    """Everything of the bench at the cursor; returns it as the user leaves it."""
    for name in ("above", "below"):
        bench = edit(ui, bench, only=(name,))
        bench = _named(bench, name)
    bench = edit(ui, bench, only=("angle",))
    bench = _drawing(bench, ui.scale)
    _told(bench)
    if imgui.button("The other way"):
        bench = bench.swapped()
    imgui.set_item_tooltip("exchange the media; the ray goes back the way it went")
    if bench.critical is not None:
        imgui.same_line()
        if imgui.button("To the critical angle"):
            bench = bench.snapped(bench.critical)
    fresnel_plot.draw(bench, ui.scale, theme)
    return bench


def _named(bench: Bench, name: str) -> Bench:
    """Buttons for the media that have names."""
    imgui.dummy(imgui.ImVec2(0, 0))
    imgui.same_line(LABELS * imgui.get_font_size())
    for i, (word, index) in enumerate(MEDIA.items()):
        if i:
            imgui.same_line(0.0, 0.3 * imgui.get_font_size())
        if imgui.small_button(f"{word}##{name}"):
            bench = replace(bench, **{name: index})
        imgui.set_item_tooltip(f"refractive index {index:g}")
    return bench


def _told(bench: Bench) -> None:
    """The angles in words."""
    refracted, critical = bench.refracted, bench.critical
    there = "nothing gets through" if refracted is None else f"{refracted:.2f}° beyond"
    imgui.text(f"{bench.angle:.2f}° to the normal, {there}")
    share = float(bench.shares.mean[0])
    imgui.text(f"reflected {100.0 * share:.1f} %, refracted {100.0 * (1.0 - share):.1f} %")
    if critical is None:
        imgui.text_disabled(f"no critical angle; Brewster's angle {bench.brewster:.2f}°")
    else:
        imgui.text_disabled(f"critical angle {critical:.2f}°, Brewster's {bench.brewster:.2f}°")


def _drawing(bench: Bench, scale: float) -> Bench:
    """Two media and three rays; the incoming one follows the mouse."""
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    line = imgui.get_font_size()
    high = HIGH * line
    centre = imgui.ImVec2(at.x + 0.5 * width, at.y + 0.5 * high)
    imgui.invisible_button("##ray", imgui.ImVec2(max(width, 1.0), high))
    if imgui.is_item_hovered() or imgui.is_item_active():
        imgui.set_mouse_cursor(imgui.MouseCursor_.hand)
    if imgui.is_item_active():
        mouse = imgui.get_io().mouse_pos
        bench = bench.snapped(angle_at(mouse.x - centre.x, centre.y - mouse.y))
    paint = imgui.get_window_draw_list()
    paint.push_clip_rect(at, imgui.ImVec2(at.x + width, at.y + high), True)
    _media(bench, at, width, high)
    _rays(bench, centre, 0.46 * min(width, high), scale)
    paint.pop_clip_rect()
    return bench


def _media(bench: Bench, at: imgui.ImVec2, width: float, high: float) -> None:
    """Two rectangles, the denser the bluer, with names and indices; the normal between them."""
    paint, line = imgui.get_window_draw_list(), imgui.get_font_size()
    faint, middle = imgui.get_color_u32(imgui.Col_.text_disabled), at.y + 0.5 * high
    for index, top, text in (
        (bench.above, at.y, at.y + 0.3 * line),
        (bench.below, middle, at.y + high - 1.4 * line),
    ):
        strength = 0.06 + 0.5 * (index - 1.0) / (FULL - 1.0)
        colour = imgui.get_color_u32(imgui.ImVec4(*GLASS, strength))
        high_end = imgui.ImVec2(at.x + width, top + 0.5 * high)
        paint.add_rect_filled(imgui.ImVec2(at.x, top), high_end, colour)
        words = f"{medium(index)} n = {index:.4g}".strip()
        wide = imgui.calc_text_size(words).x
        paint.add_text(imgui.ImVec2(at.x + width - wide - 0.4 * line, text), faint, words)
    x = at.x + 0.5 * width
    paint.add_line(imgui.ImVec2(at.x, middle), imgui.ImVec2(at.x + width, middle), faint, 1.5)
    dash = 0.5 * line
    for i in range(int(high / dash)):
        if i % 2 == 0:
            top = at.y + i * dash
            paint.add_line(imgui.ImVec2(x, top), imgui.ImVec2(x, top + 0.6 * dash), faint)


def _rays(bench: Bench, centre: imgui.ImVec2, length: float, scale: float) -> None:
    """Incoming, reflected and refracted ray, as thick as the light they carry; their angles."""
    share, refracted = float(bench.shares.mean[0]), bench.refracted
    across, up = ends(bench.angle, length)
    kind = TOTAL if refracted is None else REFLECTION
    start = imgui.ImVec2(centre.x - across, centre.y - up)
    if bench.critical is not None:
        _critical(bench.critical, centre, length)
    _ray(start, centre, PRIMARY, 1.0, scale)
    _ray(centre, imgui.ImVec2(centre.x + across, centre.y - up), kind, share, scale)
    _arc(centre, -bench.angle, 0.0, 0.42 * length, f"{bench.angle:.1f}°")
    _arc(centre, bench.angle, 0.0, 0.42 * length, f"{bench.angle:.1f}°")
    if refracted is not None:
        across, down = ends(refracted, length)
        end = imgui.ImVec2(centre.x + across, centre.y + down)
        _ray(centre, end, REFRACTION, 1.0 - share, scale)
        _arc(centre, 180.0 - refracted, 180.0, 0.42 * length, f"{refracted:.1f}°")
    paint = imgui.get_window_draw_list()
    paint.add_circle_filled(start, 5.0 * scale, ink(PRIMARY))
    paint.add_circle(start, 5.0 * scale, imgui.IM_COL32(0, 0, 0, 150), 0, 1.0 * scale)


def _ray(a: imgui.ImVec2, b: imgui.ImVec2, kind: str, share: float, scale: float) -> None:
    """An arrow with its head in the middle, where there is room for it."""
    paint, thick = imgui.get_window_draw_list(), (THIN + (THICK - THIN) * share) * scale
    rim = imgui.IM_COL32(0, 0, 0, 150)
    paint.add_line(a, b, rim, thick + 2.0 * scale)
    paint.add_line(a, b, ink(kind), thick)
    x, y = b.x - a.x, b.y - a.y
    long = max((x * x + y * y) ** 0.5, 1e-6)
    x, y = x / long, y / long
    head = HEAD * scale + 0.5 * thick
    tip = imgui.ImVec2(a.x + 0.62 * long * x, a.y + 0.62 * long * y)
    back = imgui.ImVec2(tip.x - 1.6 * head * x, tip.y - 1.6 * head * y)
    left = imgui.ImVec2(back.x - 0.7 * head * y, back.y + 0.7 * head * x)
    right = imgui.ImVec2(back.x + 0.7 * head * y, back.y - 0.7 * head * x)
    paint.add_triangle_filled(tip, left, right, ink(kind))
    paint.add_triangle(tip, left, right, rim)


def _critical(angle: float, centre: imgui.ImVec2, length: float) -> None:
    """Where the incoming ray would be at the critical angle."""
    paint, faint = imgui.get_window_draw_list(), imgui.get_color_u32(imgui.Col_.text_disabled)
    across, up = ends(angle, length)
    for i in range(0, 12, 2):
        a, b = i / 12.0, (i + 1) / 12.0
        low = imgui.ImVec2(centre.x - a * across, centre.y - a * up)
        high = imgui.ImVec2(centre.x - b * across, centre.y - b * up)
        paint.add_line(low, high, faint)
    at = imgui.ImVec2(centre.x - 1.08 * across, centre.y - 1.08 * up)
    half = 0.5 * imgui.calc_text_size("critical").x
    paint.add_text(imgui.ImVec2(at.x - 1.6 * half, at.y - imgui.get_font_size()), faint, "critical")


def _arc(centre: imgui.ImVec2, ray: float, normal: float, radius: float, words: str) -> None:
    """The angle between a ray and the normal; both in degrees from straight up to the right."""
    paint, strong = imgui.get_window_draw_list(), imgui.get_color_u32(imgui.Col_.text)
    low, high = min(ray, normal), max(ray, normal)
    if high - low < 3.0:
        return
    paint.path_arc_to(centre, radius, radians(low) - 0.5 * pi, radians(high) - 0.5 * pi, 24)
    paint.path_stroke(strong, 1.2)
    size, line = imgui.calc_text_size(words), imgui.get_font_size()
    far = radius + 0.55 * line + 0.25 * size.x
    across, up = ends(words_at(ray, normal, size.x / far, line / far), far)
    at = imgui.ImVec2(centre.x + across - 0.5 * size.x, centre.y - up - 0.5 * line)
    paint.add_text(at, strong, words)


def words_at(ray: float, normal: float, wide: float, high: float) -> float:
    """Where the words of an angle stand, in degrees: in its middle, or else beyond the ray.

    ``wide`` and ``high`` are the size of the words in units of their distance from the corner.
    """
    half = radians(0.5 * abs(ray - normal))
    across = wide * abs(cos(2.0 * half)) + high * abs(sin(2.0 * half))  # seen along the ray
    if sin(half) > 0.5 * max(wide, across):
        return 0.5 * (ray + normal)
    aside = degrees(asin(min(0.5 * wide + 0.7 * high, 1.0)))  # and the ray and its head are thick
    return ray + copysign(aside, ray - normal)
