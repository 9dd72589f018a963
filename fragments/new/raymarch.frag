// A scene to begin with: three balls that melt into each other, drawn by marching along rays. map()
// tells how far the nearest surface is; a ray may go on by that much without passing through anything.
//
// Save this file while the window is open: the picture follows at once, and the sliders stay where they
// are. Drag the mouse over the picture to walk round it.

// A uniform whose comment begins with //@ is a slider. Its default stands first, its range in brackets,
// what it does in quotes; `unit` is shown behind the number.
uniform float melt;  //@ 0.6 [0.01, 1] unit=m "how far the balls reach for each other"
uniform float speed; //@ 0.15 [0, 1] unit=1/s "turns of the balls"
// A vec3 with a # is a colour.
uniform vec3  skin;  //@ #e4572e "colour of the balls"
uniform vec3  sky;   //@ #9cc5e8 "colour of the sky, and of the light from above"
// `quality` says that more of it costs time and takes away error: `glint study` measures both. `log`
// gives small values as much of the slider as large ones.
uniform int   steps; //@ 96 [8, 256] log quality "steps along a ray"

const float kFar = 30.0;        // m
const float kTouch = 1e-3;      // m: nearer is on the surface
const float kTurn = 6.2831853;  // radians

// Two distances, joined without a crease where they differ by less than k.
float softMin(float a, float b, float k) {
    float h = max(k - abs(a - b), 0.0) / k;
    return min(a, b) - 0.25 * k * h * h;
}

// From 0 to 1, so many times a second. iTick counts time in 1/65536 s: whole numbers are as exact after
// a year as in the first second, where sin(iTime) has lost its digits.
float turns(float hz) {
    return float(uint(int(hz * 65536.0)) * iTick) / 4294967296.0;
}

// Distance to the nearest surface, m.
float map(vec3 pos) {
    float turn = kTurn * turns(speed);
    float d = pos.y;  // the ground
    for (int i = 0; i < 3; ++i) {
        float angle = turn + kTurn * float(i) / 3.0;
        vec3 centre = vec3(0.8 * cos(angle), 0.7 + 0.4 * sin(2.0 * angle), 0.8 * sin(angle));
        d = softMin(d, length(pos - centre) - 0.6, melt);
    }
    return d;
}

// How far a ray goes until it meets something; kFar where it meets nothing. A ray that runs out of
// steps is close to something, or it would have gone far.
float march(vec3 ro, vec3 rd) {
    float t = 0.0;
    for (int i = 0; i < steps && t < kFar; ++i) {
        float d = map(ro + t * rd);
        if (d < kTouch) return t;
        t += d;
    }
    return min(t, kFar);
}

// The direction in which the distance grows, from four points round the place. A loop with one call
// compiles faster than four calls: drivers copy a function to wherever it is called.
vec3 normalAt(vec3 pos) {
    vec3 nor = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 corner = vec3((i & 1) * 2 - 1, (i >> 1) * 2 - 1, ((i ^ (i >> 1)) & 1) * -2 + 1);
        nor += corner * map(pos + kTouch * corner);
    }
    return nor / max(length(nor), 1e-9);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    // iMouse.xy stays where the mouse was dragged to last; before, it is 0.
    vec2 drag = iMouse.x > 0.0 ? iMouse.xy / iResolution.xy : vec2(0.1, 0.25);
    float around = kTurn * drag.x, up = mix(0.05, 1.4, clamp(drag.y, 0.0, 1.0));
    vec3 ro = vec3(0, 0.6, 0) + 4.0 * vec3(cos(up) * cos(around), sin(up), cos(up) * sin(around));
    vec3 ahead = normalize(vec3(0, 0.6, 0) - ro);
    vec3 right = normalize(cross(ahead, vec3(0, 1, 0)));
    vec3 rd = normalize(p.x * right + p.y * cross(right, ahead) + 1.9 * ahead);

    vec3 color = mix(vec3(0.9), sky, clamp(2.0 * rd.y + 0.4, 0.0, 1.0));
    float t = march(ro, rd);
    if (t < kFar) {
        vec3 pos = ro + t * rd, nor = normalAt(pos);
        vec3 sun = normalize(vec3(0.8, 0.6, 0.5));
        vec3 paint = mix(vec3(0.2), skin, smoothstep(0.02, 0.3, pos.y));
        float shade = clamp(map(pos + 0.4 * nor) / 0.4, 0.0, 1.0);  // dark where something is near
        vec3 light = max(dot(nor, sun), 0.0) * vec3(1.1, 0.9, 0.7);
        light += (0.3 + 0.25 * nor.y) * sky * shade;
        color = mix(color, paint * light, exp(-0.006 * t * t));  // haze
    }
    fragColor = vec4(sqrt(clamp(color, 0.0, 1.0)), 1.0);
}
