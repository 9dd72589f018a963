// A scene to begin with: a stick drawn through water. A pass computes how the water moves in steps of a
// fixed length, so that it moves the same at any frame rate, in the window and in a film.
//
// Press the mouse on the water to take the stick. Save this file while the window is open: the picture follows at once,
// and both the sliders and the water stay as they are.

// A uniform whose comment begins with //@ is a slider. Its default stands first, its range in brackets,
// what it does in quotes; `unit` is shown behind the number. `log` gives small values as much of the
// slider as large ones.
uniform float tension; //@ 0.35 [0.02, 0.45] "how fast waves run: cells a step, squared"
uniform float calm;    //@ 0.4 [0.05, 10] log unit=1/s "how fast they die down"
uniform float press;   //@ 0.05 [0, 0.3] "how hard the stick presses the water"
// A vec3 with a # is a colour.
uniform vec3  water;   //@ #1b6ca8 "colour of the water"

// `pass mainPond` makes the sampler a buffer that the function mainPond() fills; `size` is in cells.
// `step=1/120` is the length of a step in seconds: as many are made as time has passed. `wrap=mirror`
// throws waves back at the rim. Red keeps the height, green the speed.
uniform sampler2D pond; //@ pass mainPond size=320x180 step=1/120 wrap=mirror

const vec2 kCells = vec2(320.0, 180.0);
const float kStick = 4.0;        // cells
const float kTurn = 6.2831853;  // radians

// From 0 to 1, so many times a second. iTick counts time in 1/65536 s: whole numbers are as exact after
// a year as in the first second, where sin(iTime) has lost its digits.
float turns(float hz) {
    return float(uint(int(hz * 65536.0)) * iTick) / 4294967296.0;
}

// How far a stick at this place presses the cell, from 0 to 1.
float dent(vec2 cell, vec2 place) {
    vec2 away = (cell - place) / kStick;
    return exp(-dot(away, away));
}

vec2 cellAt(ivec2 cell) {
    // Mirrored at the rim, as `wrap=mirror` does for texture().
    ivec2 last = ivec2(kCells) - 1;
    return texelFetch(pond, last - abs(last - abs(cell)), 0).rg;
}

// In a pass with steps, iTimeDelta is the length of one, in seconds, and iFrame counts them.
void mainPond(out vec4 result, in vec2 pixel) {
    ivec2 cell = ivec2(pixel);
    vec2 here = cellAt(cell);
    float around = cellAt(cell + ivec2(1, 0)).r + cellAt(cell - ivec2(1, 0)).r +
                   cellAt(cell + ivec2(0, 1)).r + cellAt(cell - ivec2(0, 1)).r;
    // A cell is pulled to the mean of its neighbours. Stable while tension is below 0.5.
    float speed = (here.g + tension * (around - 4.0 * here.r)) * exp(-calm * iTimeDelta);
    float height = here.r + speed;

    float phase = kTurn * turns(0.1);
    vec2 stick = 0.5 + 0.35 * vec2(sin(3.0 * phase), cos(2.0 * phase));
    if (iMouse.z > 0.0) stick = iMouse.xy / iResolution.xy;
    height -= press * dent(pixel, kCells * stick);

    // A value that is no number would spread over the whole pond: it is taken out where it arises.
    bool isSound = abs(height) < 4.0 && abs(speed) < 4.0;
    result = isSound ? vec4(height, speed, 0.0, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy, cell = 1.0 / kCells;
    // The slope of the water, from its height left and right, below and above.
    vec2 slope = vec2(texture(pond, uv + vec2(cell.x, 0)).r - texture(pond, uv - vec2(cell.x, 0)).r,
                      texture(pond, uv + vec2(0, cell.y)).r - texture(pond, uv - vec2(0, cell.y)).r);
    vec3 nor = normalize(vec3(-6.0 * slope, 1.0));
    vec3 light = normalize(vec3(-0.5, 0.6, 0.6));
    float shine = pow(max(dot(reflect(-light, nor), vec3(0, 0, 1)), 0.0), 20.0);
    vec3 color = water * (0.2 + 1.1 * max(dot(nor, light), 0.0)) + shine;
    fragColor = vec4(clamp(color, 0.0, 1.0), 1.0);
}
