// A scene to begin with. As on Shadertoy, mainImage() gives every pixel its colour; iResolution is the
// size of the picture in pixels, iTime the time in seconds, iMouse where the mouse is.
//
// Save this file while the window is open: the picture follows at once, and the sliders stay where they
// are. `Ctrl+S` in the window keeps what the sliders say in a preset, a small file of its own.

// A uniform whose comment begins with //@ is a slider. Its default stands first, its range in brackets,
// what it does in quotes. An int moves in whole steps.
uniform int   folds; //@ 5 [2, 12] "directions that the waves come from"
// `log` gives small values as much of the slider as large ones; the range then begins above 0.
uniform float zoom;  //@ 24 [4, 120] log "how many waves fit in"
// `unit` is shown behind the number.
uniform float speed; //@ 0.2 [-2, 2] unit=1/s "how fast they run"
// A vec3 with a # is a colour.
uniform vec3  deep;  //@ #0b2545 "colour of the troughs"
uniform vec3  bright; //@ #ffd166 "colour of the crests"

const float kPi = 3.14159265;

// From 0 to 1, so many times a second. iTick counts time in 1/65536 s: whole numbers are as exact after
// a year as in the first second, where sin(iTime) has lost its digits.
float turns(float hz) {
    return float(uint(int(hz * 65536.0)) * iTick) / 4294967296.0;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    // 0 in the middle, 1 at the upper edge and -1 at the lower one, whatever the size of the window.
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    // While a mouse button is down, the pattern hangs on the mouse.
    if (iMouse.z > 0.0) p -= (2.0 * iMouse.xy - iResolution.xy) / iResolution.y;

    // Waves from all directions add up to a pattern that never repeats: a quasicrystal.
    float height = 0.0, phase = 2.0 * kPi * turns(speed);
    for (int i = 0; i < folds; ++i) {
        float angle = kPi * float(i) / float(folds);
        height += cos(zoom * dot(p, vec2(cos(angle), sin(angle))) + phase);
    }
    height = 0.5 + 0.5 * height / float(folds);

    vec3 color = mix(deep, bright, smoothstep(0.3, 0.9, height));
    fragColor = vec4(color * (1.0 - 0.2 * dot(p, p) / (1.0 + dot(p, p))), 1.0);
}
