// A pool: wind waves, drops and the touch of a hand on clear water over mosaic.
//
// An infinity pool above the sea at any hour. Columns, steps, a mirror ball and floating lanterns
// stand half in the water; rain and the mouse raise rings that run round them. Press to drop a
// stone; `mouse` decides whether a drag turns the camera or draws a wake.
//
// Method   The surface is a height: eight plane waves with exact phases, plus the wave equation in
//          a buffer (240 steps a second, by what crosses between cells, so that walls and columns
//          reflect and no water is lost; shallows are slower). `traced` follows the real rays: a
//          march that at `overstep` 1 cannot pass the surface, then Illinois steps; exact Fresnel
//          shares; refraction first, reflection later from a one-place queue; ray differentials
//          carry the footprint through every bend, so that tiles seen through the water are
//          filtered. `planar` is the classic way: one picture mirrored in the plane of the water,
//          one refracted by it, each shifted as the slope asks. The shift comes from the distance
//          to what is seen, so it is 0 where a thing meets the water. Sunlight on the floor: its
//          point of entry by two fixed-point steps, then 1/|J|.
// Sources  Courant, Friedrichs, Lewy, Math. Ann. 100 (1928): stability. Igehy, SIGGRAPH (1999), eq.
//          9-18: ray differentials. Dowell and Jarratt, BIT 11 (1971): Illinois. Born and Wolf,
//          Principles of Optics, 1.5: Fresnel. Bruneton, Neyret, Holzschuch, CGF 29(2) (2010):
//          filtered waves. Nishita et al., SIGGRAPH (1993): sky. Kasten and Young, Appl. Opt. 28
//          (1989): air mass. Jarzynski and Olano, JCGT 9(3) (2020): pcg3d.
// Units    1 unit = 1 m, y up, 0 the water at rest, linear sRGB colour, radiance: noon sun 10.
// Passes   air, sky: on change of a tweak. wavelets, floats: every frame, tiny. bed, pushes, pond:
//          the simulation; screen: only its size counts. relief, bend, heights, peaks, crest: the
//          shape of the rings, once a frame. mirror, below, dudv: `planar` only.
// Defaults From `glint study presets/water.toml`: traced costs less than planar here, which is
//          0.040 (RMSE) off; 6 rays are 0.004 from 24; marchSteps 64 draw what 1024 do, and 320
//          leave no more than 0.1 % of the rays out of steps in the wildest rain; overstep 1.4 is
//          0.002 from 1, in 7 % less time; 3 steps of refinement are 1e-5 from 8.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Water
uniform int   water; //@ 1 {planar, traced} quality reference=1 "of mirror images"
uniform float waveHeight;      //@ 0.022 [0, 0.12] unit=m "highest crest that the wind can raise"
uniform float longestWave;     //@ 1.7 [0.6, 6] log unit=m "wind waves, crest to crest"
uniform float windAngle;       //@ 20 [-180, 180] unit=deg "where the waves run; 0: from the sea"
uniform float windSpread;      //@ 70 [0, 180] unit=deg "to either side"
uniform float depth;           //@ 1.5 [0.8, 4] unit=m "of the pool"
uniform vec3  waterTint;       //@ #3fd6dc "what 3 m of water leave of white light"
uniform float caustics;        //@ 1.0 [0, 1] "light gathered by the waves; 0 is even light"
uniform float animation;       //@ 1.0 [0, 8] "speed of the wind's waves"
//@ group Ripples
uniform bool  ripples;         //@ on "the simulated surface"
uniform float rain;            //@ 1.5 [0, 60] unit=1/s "drops that fall into the pool"
uniform float dropSize;        //@ 0.13 [0.09, 0.5] log unit=m "radius of the dent"
uniform float dropForce;       //@ 0.9 [0, 3] unit=m/s "of a drop, or of a press of the mouse"
uniform float waveSpeed;       //@ 0.9 [0.2, 3.75] log unit=m/s "of rings over deep water"
uniform float damping;         //@ 0.35 [0.05, 5] log unit=1/s "how fast they die"
uniform int   mouse;           //@ 0 {orbit, touch} "what a drag does; a press is a drop in both"
//@ group Pool
uniform float tileSize;        //@ 0.14 [0.03, 0.6] log unit=m "of the mosaic"
uniform vec3  tileColour;      //@ #8fe3e6 "of the mosaic"
uniform bool  columns;         //@ on "six columns and their beams"
uniform bool  mirrorBall;      //@ on "a steel ball"
uniform bool  steps;           //@ on "into the water"
uniform int   lanterns;        //@ 5 [0, 8] "floating spheres"
//@ group Light
uniform float sunHeight;       //@ 11 [-12, 80] unit=deg "over the horizon"
uniform float sunAngle;        //@ -14 [-180, 180] unit=deg "to the right of the sea's middle"
uniform float haze;            //@ 1.0 [0.1, 6] log "dust in the air"
uniform float clouds;          //@ 0.5 [0, 1] "how much of the sky they cover"
uniform float stars;           //@ 0.0 [0, 4] "brightness"
uniform float poolLights;      //@ 0.0 [0, 8] "six lamps under water"
uniform float lanternGlow;     //@ 0.0 [0, 8] "light of the floating spheres"
//@ group Camera
uniform float cameraDistance;  //@ 9.2 [1, 14] unit=m "from the point looked at, level"
uniform float cameraAngle;     //@ 8 [-180, 180] unit=deg "round it"
uniform float cameraHeight;    //@ 1.7 [0.3, 8] unit=m "of the eye"
uniform float targetX;         //@ 0.0 [-4, 4] unit=m "of the point looked at, to the right"
uniform float targetZ;         //@ 0.0 [-6, 6] unit=m "of the point looked at, from the sea"
uniform float targetHeight;    //@ 0.75 [-1, 4] unit=m "of the point looked at"
uniform float focalLength;     //@ 24 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-6, 10] unit=stop "before the display curve"
//@ group Quality
uniform int   rays;            //@ 6 [2, 24] quality reference=24 "rays along one path"
uniform int   marchSteps;      //@ 320 [4, 1024] log quality reference=1024 second=overstep=1 "towards the surface"
uniform float overstep;        //@ 1.4 [1, 3] quality reference=1 "1: never beyond what is safe"
uniform int   refinement;      //@ 3 [0, 8] quality reference=8 "Illinois steps at the end"
uniform int   antialias;       //@ 1 [1, 32] log quality reference=32 "paths a pixel"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D air;         //@ pass mainAir size=64x128
uniform sampler2D sky;  //@ pass mainSky size=2048x512 format=rgba16f wrap=repeat filter=mipmap
uniform sampler2D wavelets;    //@ pass mainWavelets size=8x1
uniform sampler2D bedEast;     //@ pass mainBed size=64x384 filter=nearest
uniform sampler2D bedNorth;    //@ pass mainBed size=64x384 filter=nearest
uniform sampler2D screen;      //@ pass mainScreen format=r8
uniform sampler2D pushes;      //@ pass mainPushes size=2x1 step=1/240
uniform sampler2D pond;        //@ pass mainPond size=64x384 step=1/240 bounded=[-1, 1] filter=nearest
uniform sampler2D pondEast;    //@ pass mainPond size=64x384 step=1/240 filter=nearest
uniform sampler2D pondNorth;   //@ pass mainPond size=64x384 step=1/240 filter=nearest
uniform sampler2D relief;      //@ pass mainRelief size=256x384
uniform sampler2D bend;        //@ pass mainRelief
uniform sampler2D heights;     //@ pass mainHeights size=256x384 format=r32f
uniform sampler2D levels;      //@ buffer heights filter=nearest
uniform sampler2D peaks;       //@ pass mainPeaks size=32x48
uniform sampler2D crest;       //@ pass mainCrest size=1x1 format=rg32f
uniform sampler2D floats;      //@ pass mainFloats size=8x1
uniform sampler2D dudv;        //@ pass mainDudv size=256x384 filter=mipmap
uniform sampler2D mirror;      //@ pass mainMirror
uniform sampler2D below;       //@ pass mainBelow

// ---- Constants and numbers ----------------------------------------------------------------------
// The pool is a box round the origin, the terrace lies round it, and what stands in it has a number
// of its own. Colours are of the materials; light comes from the sky's buffer and the sun alone.

const float kPi = 3.14159265358979;
const float kFar = 1e9;                       // m, a miss
const float kGravity = 9.81;                  // m/s2
const float kIorWater = 1.333;                // visible light, 20 C
const float kLeastCarry = 0.004;              // a path that carries less is over
const vec2  kPool = vec2(4.0, 6.0);           // m, half width and half length
const float kPatch = 0.25;                    // m, of the pool, whose crests are known
const float kDeck = 0.14;                     // m, the paving's height over the water
const float kBrim = -0.4;                     // m, one sees over the far wall
const float kTerrace = 13.0;                  // m, half size of the paving
const float kEyeLevel = 40.0;                 // m, terrace over the sea
const float kShaft = 0.23, kFoot = 0.31;      // m, radii of a column, of its foot and head
const float kFootTop = 0.10, kHead = 3.14, kColumnTop = 3.3;   // m
const vec2  kColumnFirst = vec2(-2.55, -4.3), kColumnStep = vec2(5.1, 3.4);   // m
const vec3  kBeamHalf = vec3(0.22, 0.19, 4.2);           // m
const vec4  kBallPlace = vec4(-0.60, 0.10, -1.0, 0.55);  // m: centre, radius
const float kCeiling = 0.3;                   // m, no ring is higher: they break
const float kMargin = 1.12;                   // planar pictures show this much more
const int   kCells = 8;                       // cells of the pond along one texel of `peaks`
const int   kSky = 0, kFloor = 1, kWall = 2, kStep = 3, kPaving = 4, kStone = 5, kColumn = 6;
const int   kBall = 7, kLantern = 8;          // and on

struct Hit { float t; vec3 nor; int id; };
// A ray with its differentials to the next pixel across and up: of the origin, of the direction.
struct Ray { vec3 o, d, ox, oy, dx, dy, carry; float rough; bool wet; };
// A point to be lit, what the path carries from there, and the sides of the pixel on it.
struct Matt { vec3 pos, nor, x, y, carry; float cosine; int id; bool wet; };

uvec3 hash3(ivec3 q) {
    uvec3 v = uvec3(q) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}
vec3 random3(ivec3 q) { return vec3(hash3(q) >> 8u) / 16777216.0; }
// A texel of a buffer that `filter=nearest` reads, from its place and how many there are; half the
// price of texelFetch on llvmpipe.
vec4 fetch(sampler2D buffer, vec2 place, vec2 texels) {
    return textureLod(buffer, (place + 0.5) / texels, 0.0);
}

// Cycles since the start, modulo 1, of a motion; its frequency is cut to a multiple of 1/65536 Hz.
float cycles(float hz) { return float(uint(hz * animation * 65536.0) * iTick) / 4294967296.0; }
// 0, which compilers cannot know: a loop that starts there is not unrolled, and compiled sooner.
int loopStart() { return min(0, int(iSampleRate)); }

vec2 turn(vec2 p, float angle) {
    float c = cos(angle), s = sin(angle);
    return vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
float square(float x) { return x * x; }
vec3 linearColour(vec3 c) {   // from sRGB, a fit to 1/500
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

// A start for a secondary ray: some 8 ulp along the normal from a point that lies on the surface.
vec3 liftOff(vec3 p, vec3 nor) { return p + nor * (1e-6 * max(maxComponent(abs(p)), 0.1)); }

vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}

// Reflected share of unpolarised light, exact; eta: index beyond over index before the surface.
float fresnel(float cosI, float eta) {
    float gg = (eta - 1.0) * (eta + 1.0) + cosI * cosI;
    if (gg <= 0.0) return 1.0;
    float g = sqrt(gg);
    float a = (g - cosI) / max(g + cosI, 1e-9);
    float b = (cosI * (g + cosI) - 1.0) / (cosI * (g - cosI) + 1.0);
    return min(0.5 * a * a * (1.0 + b * b), 1.0);
}

// Coverage of a pixel of width w, centred at x, by lines of half-width h at every integer.
float lines(float x, float h, float w) {
    w = max(w, 1e-4);
    float a = x - 0.5 * w, b = x + 0.5 * w;
    vec2 whole = floor(vec2(a, b) + 0.5), part = clamp(vec2(a, b) - whole, -h, h);
    return clamp((2.0 * h * (whole.y - whole.x) + part.y - part.x) / w, 0.0, 1.0);
}
// The same by one stripe from a to b.
float stripe(float x, float a, float b, float w) {
    w = max(w, 1e-4);
    return clamp((min(x + 0.5 * w, b) - max(x - 0.5 * w, a)) / w, 0.0, 1.0);
}

vec3 absorption() { return -log(clamp(linearColour(waterTint), 0.002, 0.998)) / 3.0; }   // 1/m
vec3 towardsSun() {
    float e = radians(sunHeight), a = radians(sunAngle);
    return vec3(cos(e) * sin(a), sin(e), -cos(e) * cos(a));
}
// Irradiance of the sun over pi, facing it, for a lamp of 1 above the air.
vec3 sunColour() {
    float h = max(sunHeight, -2.0);
    float mass = 1.0 / (max(sin(radians(h)), 0.0) + 0.15 * pow(h + 3.885, -1.253));
    vec3 tau = vec3(0.042, 0.098, 0.24) + vec3(0.030, 0.036, 0.044) * haze;
    return 10.0 * smoothstep(-1.0, 1.5, sunHeight) * exp(-tau * mass);
}

// ---- Waves --------------------------------------------------------------------------------------
// The surface is a height over the pool's plane: waves of wind, which are cosines with exact
// phases, and rings, which are a simulation in a buffer. For light all that counts is the slope,
// which turns a ray, and the second derivatives, which say how much a bundle of rays spreads or
// gathers. A ray finds the surface by steps that cannot pass it: with gap g above the water, the
// ray closing in at the speed c of its own fall plus the steepest rise of the waves, nothing is
// nearer than g / c. That is a march with `overstep` 1; at its default a step is up to 1.4 times as
// long, since waves are seldom at their steepest, and may cut a crest by 0.1 mm.

// What all rays of a pixel share, fetched once: the eight plane waves of this frame and the sum of
// their heights, the greatest height and slope of the rings, the lanterns, light of the whole sky.
vec4 gKx[2], gKz[2], gHeight[2], gPhase[2];
float gCrests = 0.0;
vec2 gRings = vec2(0.0);
vec4 gLanterns[8];
vec3 gAmbient;

void loadWaves() {
    gCrests = 0.0;
    for (int g = 0; g < 2; ++g) {
        gKx[g] = texelFetch(wavelets, ivec2(4 * g, 0), 0);
        gKz[g] = texelFetch(wavelets, ivec2(4 * g + 1, 0), 0);
        gHeight[g] = texelFetch(wavelets, ivec2(4 * g + 2, 0), 0);
        gPhase[g] = texelFetch(wavelets, ivec2(4 * g + 3, 0), 0);
        gCrests += dot(gHeight[g], vec4(1.0));
    }
    if (ripples) gRings = texelFetch(crest, ivec2(0), 0).xy;
}
void loadAll() {
    loadWaves();
    for (int i = 0; i < lanterns; ++i) gLanterns[i] = texelFetch(floats, ivec2(i, 0), 0);
    gAmbient = 0.5 * (textureLod(sky, vec2(0.25, 0.75), 8.0).rgb    // 8 by 2 texels
                      + textureLod(sky, vec2(0.75, 0.75), 8.0).rgb);
}

vec2 pondUv(vec2 p) { return p / (2.0 * kPool) + 0.5; }

float waterHeight(vec2 p) {
    float h = ripples ? textureLod(heights, pondUv(p), 0.0).x : 0.0;
    if (waveHeight > 0.0)
        for (int g = 0; g < 2; ++g)
            h += dot(gHeight[g], sin(gKx[g] * p.x + gKz[g] * p.y + gPhase[g]));
    return h;
}
vec2 waterSlope(vec2 p) {
    vec2 slope = ripples ? textureLod(relief, pondUv(p), 0.0).yz : vec2(0.0);
    if (waveHeight > 0.0)
        for (int g = 0; g < 2; ++g) {
            vec4 c = gHeight[g] * cos(gKx[g] * p.x + gKz[g] * p.y + gPhase[g]);
            slope += vec2(dot(c, gKx[g]), dot(c, gKz[g]));
        }
    return slope;
}
// Slope, second derivatives xx, xz, zz, and the variance of slope that a pixel hides: each wave
// fades as its phase changes over the pixel, whose sides are a and b.
float waterShape(vec2 p, vec2 a, vec2 b, out vec2 slope, out vec3 second) {
    float hidden = 0.0;
    slope = vec2(0.0);
    second = vec3(0.0);
    if (ripples) {
        slope = textureLod(relief, pondUv(p), 0.0).yz;
        second = textureLod(bend, pondUv(p), 0.0).xyz;
        vec2 wide = vec2(dot(second.xy, a), dot(second.yz, a));
        float fade = 1.0 / (1.0 + 8.0 * (dot(a, a) + dot(b, b)));   // rings of 0.3 m
        hidden += (1.0 - fade) * dot(slope, slope) + 0.02 * min(dot(wide, wide), 1.0);
        slope *= fade;
        second *= fade;
    }
    if (waveHeight > 0.0)
        for (int g = 0; g < 2; ++g) {
            vec4 phase = gKx[g] * p.x + gKz[g] * p.y + gPhase[g];
            vec4 u = gKx[g] * a.x + gKz[g] * a.y, v = gKx[g] * b.x + gKz[g] * b.y;
            vec4 fade = exp(-min(u * u + v * v, 400.0) / 24.0);   // a box of that width
            vec4 c = gHeight[g] * fade * cos(phase), s = gHeight[g] * fade * sin(phase);
            slope += vec2(dot(c, gKx[g]), dot(c, gKz[g]));
            second -= vec3(dot(s * gKx[g], gKx[g]), dot(s * gKx[g], gKz[g]),
                           dot(s * gKz[g], gKz[g]));
            vec4 steep = gHeight[g] * gHeight[g] * (gKx[g] * gKx[g] + gKz[g] * gKz[g]);
            hidden += 0.5 * dot(steep, 1.0 - fade * fade);
        }
    return hidden;
}

// Second derivatives alone.
vec3 waterBend(vec2 p) {
    vec3 second = ripples ? textureLod(bend, pondUv(p), 0.0).xyz : vec3(0.0);
    if (waveHeight > 0.0)
        for (int g = 0; g < 2; ++g) {
            vec4 s = gHeight[g] * sin(gKx[g] * p.x + gKz[g] * p.y + gPhase[g]);
            second -= vec3(dot(s * gKx[g], gKx[g]), dot(s * gKx[g], gKz[g]),
                           dot(s * gKz[g], gKz[g]));
        }
    return second;
}

// How far a ray can go in its patch of the pool, whose own rings are less high and steep than the
// worst: to the patch's far side where it stays above them, else as its own slope bound allows.
float stepOverRings(vec3 ro, vec3 rd, vec3 inv, float t, float gap, float side, float steep) {
    vec2 ahead = step(0.0, rd.xz), nudge = 1e-4 * sign(rd.xz);   // m
    vec3 p = ro + t * rd;
    vec2 at = (p.xz + nudge + kPool) / kPatch;
    vec2 c = clamp(floor(at), vec2(0.0), 2.0 * kPool / kPatch - 1.0);
    vec3 most = texelFetch(peaks, ivec2(c), 0).xyz;
    float top = gCrests + (side > 0.0 ? most.x : most.y);
    vec2 sides = ((c + ahead) * kPatch - kPool - ro.xz) * inv.xz;
    float leave = max(min(sides.x, sides.y) - t, 0.0);
    float over = min(side * p.y, side * (p.y + leave * rd.y)) - top;
    float near = overstep * gap / max(steep + most.z * length(rd.xz), 1e-6);
    return over > 0.0 ? leave : min(near, leave);
}
// Between a point above the water and one below it (x: t, y: gap): where a line through both gaps
// is 0. The end that stays twice in a row counts half its gap, so that neither stays for ever
// (Illinois).
float closeInOnWater(vec3 ro, vec3 rd, float side, vec2 lo, vec2 hi, inout int evaluations) {
    float t = hi.x, gap = hi.y;
    for (int i = 0; i < refinement && abs(gap) > 2e-5; ++i) {   // m
        t = clamp(hi.x - hi.y * (hi.x - lo.x) / min(hi.y - lo.y, -1e-12), lo.x, hi.x);
        vec3 p = ro + t * rd;
        float now = side * (p.y - waterHeight(p.xz));
        ++evaluations;
        bool same = (now > 0.0) == (gap > 0.0) && i > 0;
        if (now > 0.0) {
            lo = vec2(t, now);
            if (same) hi.y *= 0.5;
        } else {
            hi = vec2(t, now);
            if (same) lo.y *= 0.5;
        }
        gap = now;
    }
    return t;
}

// Where a ray meets the water before tMax, else kFar. wet: it comes from below. Steps are as long
// as the steepest possible surface allows, times `overstep` (which may also skip a crest's last 2
// cm, 0.1 mm deep). Rings are steep where a drop has fallen: each patch of the pool knows how
// steep and how high its own are. Then the sign change is closed in on.
float marchWater(vec3 ro, vec3 rd, float tMax, bool wet, out int evaluations) {
    evaluations = 0;
    float level = gCrests + gRings.x + 1e-4, side = wet ? -1.0 : 1.0;
    vec3 inv = safeInverse(rd), box = vec3(kPool.x, level, kPool.y);
    vec3 a = (-box - ro) * inv, b = (box - ro) * inv, n = min(a, b), f = max(a, b);
    float t = max(maxComponent(n), 0.0), end = min(min(f.x, f.z), min(f.y, tMax));
    float levelled = length(rd.xz), steep = 0.0;   // of the wind's waves along this ray
    for (int g = 0; g < 2; ++g)
        steep += dot(gHeight[g], abs(gKx[g] * rd.x + gKz[g] * rd.z));
    steep -= side * rd.y;
    float closing = steep + gRings.y * levelled;
    if (t >= end || closing <= 1e-6) return kFar;   // beside it, or faster up than waves rise
    float least = min(square(longestWave / 1.7), 1.0);   // short waves are soon cut
    float gap = 1e-4, before = t, gapBefore = gap;
    for (int i = 0; i <= marchSteps; ++i) {
        vec3 p = ro + t * rd;
        gap = side * (p.y - waterHeight(p.xz));
        ++evaluations;
        if (i == 0) gap = max(gap, 1e-4);   // a start within rounding of the surface
        if (gap <= 0.0 || t >= end) break;
        before = t;
        gapBefore = gap;
        float far = overstep * gap / closing;
        if (ripples) far = max(far, stepOverRings(ro, rd, inv, t, gap, side, steep));
        t += max(far, (overstep - 1.0) * least * (0.03 + 0.006 * t) + 1e-4);
        t = min(t, end);
    }
    if (gap > 0.0) return t >= end ? kFar : t;   // out of steps: nearly there
    return closeInOnWater(ro, rd, side, vec2(before, gapBefore), vec2(t, gap), evaluations);
}

// ---- Geometry -----------------------------------------------------------------------------------
// All solids are met in closed form: slabs, spheres, upright cylinders. One call finds the nearest,
// for rays in air and under water alike.

float intersectSphere(vec3 ro, vec3 rd, vec3 c, float r) {          // |rd| = 1
    vec3 f = ro - c;
    float b = dot(f, rd);
    vec3 l = f - b * rd;
    float d = r * r - dot(l, l);
    if (d < 0.0) return -1.0;
    float s = sqrt(d);
    return -b - s > 0.0 ? -b - s : -b + s;
}

vec2 columnPlace(int i) { return kColumnFirst + kColumnStep * vec2(i & 1, i >> 1); }
vec3 lampPlace(int i) {
    return vec3(kPool.x * float((i & 1) * 2 - 1), -0.42 * depth, -4.3 + 4.4 * float(i >> 1));
}
float stepTop(int i) { return 0.05 - 0.22 * float(i); }
float stepReach(int i) { return kPool.x - 0.42 * float(i + 1); }
const vec2 kStepsAlong = vec2(1.1, 4.3);   // m, z

void meetSolidBox(vec3 ro, vec3 inv, vec3 lo, vec3 hi, int id, inout Hit h) {
    vec3 a = (lo - ro) * inv, b = (hi - ro) * inv, n = min(a, b), f = max(a, b);
    float enter = maxComponent(n), leave = min(f.x, min(f.y, f.z));
    if (enter >= leave || enter <= 0.0 || enter >= h.t) return;
    vec3 axis = enter == n.y ? vec3(0, 1, 0) : enter == n.x ? vec3(1, 0, 0) : vec3(0, 0, 1);
    h = Hit(enter, -sign(inv) * axis, id);
}
void meetSolidSphere(vec3 ro, vec3 rd, vec4 ball, int id, inout Hit h) {
    float t = intersectSphere(ro, rd, ball.xyz, ball.w);
    if (t > 0.0 && t < h.t) h = Hit(t, (ro + t * rd - ball.xyz) / ball.w, id);
}

// Six columns on feet, with heads, under two beams: all upright, so that one distance from the axis
// tells of shaft and foot.
void meetColumns(vec3 ro, vec3 rd, vec3 inv, inout Hit h) {
    float across = max(dot(rd.xz, rd.xz), 1e-12);
    float disc = ((rd.y < 0.0 ? kFootTop : kHead) - ro.y) * inv.y;   // of all feet, or heads
    for (int i = 0; i < 6; ++i) {
        vec2 to = columnPlace(i) - ro.xz;
        float mid = dot(to, rd.xz) / across;
        vec2 off = to - mid * rd.xz;
        float away2 = dot(off, off), s = sqrt(max(square(kShaft) - away2, 0.0) / across);
        float t = mid - s > 0.0 ? mid - s : mid + s, y = ro.y + t * rd.y;
        if (away2 < square(kShaft) && t > 0.0 && t < h.t && y < kColumnTop && y > -depth)
            h = Hit(t, vec3(t * rd.xz - to, 0.0).xzy / kShaft, kColumn);
        t = mid - sqrt(max(square(kFoot) - away2, 0.0) / across);
        y = ro.y + t * rd.y;
        bool thick = y < kFootTop || y > kHead && y < kColumnTop;
        if (away2 < square(kFoot) && t > 0.0 && t < h.t && thick && y > -depth)
            h = Hit(t, vec3(t * rd.xz - to, 0.0).xzy / kFoot, kStone);
        if (disc > 0.0 && disc < h.t && away2 + square(disc - mid) * across < square(kFoot))
            h = Hit(disc, vec3(0.0, -sign(rd.y), 0.0), kStone);
    }
    for (int i = 0; i < 2; ++i) {
        vec3 mid = vec3(columnPlace(i).x, kColumnTop + kBeamHalf.y, columnPlace(2).y);
        meetSolidBox(ro, inv, mid - kBeamHalf, mid + kBeamHalf, kStone, h);
    }
}

// The nearest solid thing. wet: from under water the far wall is a wall; from above one sees over.
Hit intersect(vec3 ro, vec3 rd, bool wet) {
    Hit h = Hit(kFar, vec3(0.0), kSky);
    vec3 inv = safeInverse(rd);
    vec2 a = (-kPool - ro.xz) * inv.xz, b = (kPool - ro.xz) * inv.xz;
    vec2 n = min(a, b), f = max(a, b);
    float enter = max(max(n.x, n.y), 0.0), leave = min(f.x, f.y);
    float toFloor = (-depth - ro.y) * inv.y, toDeck = (kDeck - ro.y) * inv.y;
    if (leave > enter) {   // through the prism over the pool
        bool sea = f.y < f.x && rd.z < 0.0;
        float y = ro.y + leave * rd.y, top = !sea ? kDeck : wet ? kFar : kBrim;
        if (rd.y < 0.0 && toFloor > enter && toFloor < leave)
            h = Hit(toFloor, vec3(0, 1, 0), kFloor);
        else if (y < top && y > -depth - 1e-3)
            h = Hit(leave, f.x < f.y ? vec3(-sign(rd.x), 0, 0) : vec3(0, 0, -sign(rd.z)), kWall);
    }
    if (toDeck > 0.0 && rd.y < 0.0 && toDeck < h.t) {
        vec2 p = ro.xz + toDeck * rd.xz;
        bool paved = max(abs(p.x) - kPool.x, p.y - kPool.y) > 0.0 && p.y > -kPool.y;
        if (paved && max(abs(p.x), p.y) < kTerrace) h = Hit(toDeck, vec3(0, 1, 0), kPaving);
    }
    if (columns) meetColumns(ro, rd, inv, h);
    if (steps)
        for (int i = 0; i < 4; ++i)
            meetSolidBox(ro, inv, vec3(stepReach(i), -depth - 1.0, kStepsAlong.x),
                         vec3(kPool.x + 1.0, stepTop(i), kStepsAlong.y), kStep, h);
    if (mirrorBall) meetSolidSphere(ro, rd, kBallPlace, kBall, h);
    for (int i = 0; i < lanterns; ++i)
        meetSolidSphere(ro, rd, gLanterns[i], kLantern + i, h);
    return h;
}

// ---- Light --------------------------------------------------------------------------------------
// The sky's picture goes from straight down to straight up, where its outer rows lie, finest at the
// horizon; a: how clear the view of the sun is. cone: rad, what is seen as one.
vec4 skyLight(vec3 rd, float cone) {
    float lod = clamp(log2(max(cone, 1e-4) * 2048.0 / (2.0 * kPi)), 0.0, 6.0);
    float v = 0.5 + sign(rd.y) * sqrt(abs(rd.y)) * (0.5 - 0.5 / 512.0);
    float edge = exp2(ceil(lod)) / 1024.0;
    return textureLod(sky, vec2(atan(rd.x, -rd.z + 1e-9) / (2.0 * kPi) + 0.5,
                                clamp(v, edge, 1.0 - edge)), lod);
}

// One layer of stars in square cells. None is smaller than the footprint w: dimmer instead.
vec3 starLayer(vec2 uv, float cell, float radius, float w, int seed) {
    vec2 c = floor(uv / cell);
    uvec3 bits = hash3(ivec3(ivec2(c), seed));
    vec3 a = vec3(bits & 65535u) / 65536.0, b = vec3(bits >> 16u) / 65536.0;
    vec2 d = uv / cell - c - 0.3 - 0.4 * a.xy;
    float r = radius * (0.5 + a.z), seen = min(max(r, 0.75 * w), 0.14 * cell);
    float twinkle = sin(2.0 * kPi * (b.y + cycles(0.125 + 0.25 * floor(b.z * 4.0))));
    float shine = square(square(b.x * b.x * b.x)) * (0.75 + 0.25 * twinkle);   // few are bright
    float disc = exp(-dot(d, d) * square(cell / seen)) * square(r / seen);
    return mix(vec3(0.65, 0.78, 1.0), vec3(1.0, 0.86, 0.66), b.z)
        * (shine * disc * clamp(2.0 - 3.0 * w / cell, 0.0, 1.0));
}

bool gSunDisc = true;   // planar pictures leave it to the water
// The sun as a blur: its disc, seen over a cone. Its light is kept, but for a ceiling; its colour
// is half bleached, as on film.
vec3 sunGlint(vec3 rd, float cone) {
    float sigma2 = square(0.0047) + 0.25 * cone * cone;
    vec3 off = rd - towardsSun();
    return mix(sunColour(), vec3(maxComponent(sunColour())), 0.5) * min(0.5 / sigma2, 4e3)
        * exp(-min(0.5 * dot(off, off) / sigma2, 60.0));
}

// All beyond the terrace.
vec3 background(vec3 rd, float cone) {
    vec4 far = skyLight(rd, cone);
    vec3 light = far.rgb;
    if (gSunDisc) light += far.a * sunGlint(rd, cone);
    if (stars > 0.0 && rd.y > 0.0) {
        vec2 uv = rd.xz / (0.35 + rd.y);
        light += stars * far.a * (starLayer(uv, 0.05, 0.0005, cone, 41) * 9.0
                          + starLayer(uv + 0.3, 0.16, 0.0010, cone, 43) * 14.0);
    }
    return light;
}

// How much of the sun's disc, of slope `spread`, is seen past what stands within tMax; high: past
// beams and lanterns, too.
float besideAll(vec3 p, vec3 rd, float tMax, float spread, bool high) {
    float free = 1.0, across = max(dot(rd.xz, rd.xz), 1e-6);
    if (columns)
        for (int i = loopStart(); i < 6; ++i) {
            vec2 to = columnPlace(i) - p.xz;
            float t = dot(to, rd.xz) / across, soft = max(spread * t, 0.003), y = p.y + t * rd.y;
            float away = length(to - t * rd.xz) - (y < kFootTop ? kFoot : kShaft);
            if (t > 0.0 && t < tMax && y < kColumnTop) free *= smoothstep(-soft, soft, away);
        }
    if (columns && high)
        for (int i = loopStart(); i < 2; ++i) {   // the ray at their height
            float t = (kColumnTop + kBeamHalf.y - p.y) / max(rd.y, 1e-3), soft = spread * t;
            vec2 q = abs(p.xz + t * rd.xz - vec2(columnPlace(i).x, columnPlace(2).y));
            vec2 reach = kBeamHalf.xz + kBeamHalf.y * abs(rd.xz) / max(rd.y, 0.05);
            vec2 within = smoothstep(-soft, soft, reach - q);
            if (t > 0.02) free *= 1.0 - within.x * within.y;
        }
    for (int i = mirrorBall ? -1 : 0; i < (high ? lanterns : 0); ++i) {
        vec4 ball = i < 0 ? kBallPlace : gLanterns[max(i, 0)];
        vec3 to = ball.xyz - p;
        float t = dot(to, rd), soft = max(spread * t, 0.003);
        float away = length(to - t * rd) - ball.w;
        if (t > 0.0 && t < tMax) free *= smoothstep(-soft, soft, away);
    }
    return free;
}

// Refraction of the sun by nearly level water: the direction down, level offset a metre of depth
// (flat) and the matrix that a slope adds to it, for a first-order map of entry to floor.
vec3 sunUnderWater(vec3 sun, out mat2 byslope) {
    float eta = 1.0 / kIorWater, cosI = max(sun.y, 1e-3);
    float cosT = sqrt(1.0 - eta * eta * (1.0 - cosI * cosI)), m = eta * cosI - cosT;
    float bias = eta * (eta - eta * eta * cosI / cosT) / (cosT * cosT);
    byslope = mat2(bias * sun.x * sun.x - m / cosT, bias * sun.x * sun.z,
                   bias * sun.x * sun.z, bias * sun.z * sun.z - m / cosT);
    return vec3(-eta * sun.x, -cosT, -eta * sun.z);
}

// Where light that reaches a point `down` metres deep came in, and how much the waves gather it. It
// lands at p = entry + down * aside(slope there); J, the derivative of that by the entry, says on
// how many square metres of floor one of water shines: 1/|J| is how bright it is.
float gathered(vec2 p, float down, vec3 light, mat2 byslope, out vec2 entry) {
    vec2 calm = light.xz / -light.y;
    entry = p - down * calm;
    if (caustics <= 0.0) return 1.0;
    for (int i = loopStart(); i < 2; ++i) entry = p - down * (calm + byslope * waterSlope(entry));
    vec3 second = waterBend(entry);
    mat2 j = mat2(1.0) + down * byslope * mat2(second.xy, second.yz);
    float area = abs(j[0][0] * j[1][1] - j[0][1] * j[1][0]);
    // biased: one of several sheets of light where they fold, and none too sharp
    return mix(1.0, 1.0 / (area < 0.5 ? area * area + 0.25 : area), caustics);
}

// Sunlight on a surface, over pi. Under water: through the point of entry.
vec3 sunOn(vec3 p, vec3 nor, bool wet) {
    if (sunHeight <= -1.0) return vec3(0.0);
    vec3 sun = towardsSun(), from = p;
    sun.y = max(sun.y, 0.01);
    mat2 byslope;
    vec2 entry;
    vec3 light = sunUnderWater(sun, byslope);
    float down = max(-p.y, 0.0), gather = gathered(p.xz, down, light, byslope, entry), free = 1.0;
    if (wet) from = vec3(entry.x, 0.0, entry.y);
    float facing = wet ? dot(nor, light) / light.y : dot(nor, sun), path = length(from - p);
    free *= besideAll(from, sun, kFar, wet ? 0.012 : 0.006, true);
    if (wet) {
        free *= besideAll(p, -light, path, 0.05, false);
        vec2 within = smoothstep(-0.04 * down - 0.01, 0.04 * down + 0.01, kPool - abs(entry));
        // Over the rim: the paving stands higher than the water, the sea's side does not.
        vec2 inv = safeInverse(sun).xz;
        vec2 leave = (mix(-kPool, kPool, greaterThan(inv, vec2(0.0))) - entry) * inv;
        bool sea = leave.y < leave.x && sun.z < 0.0;
        float rim = smoothstep(kDeck - 0.02, kDeck + 0.02, min(leave.x, leave.y) * sun.y);
        free *= within.x * within.y * (sea ? 1.0 : rim)
            * (1.0 - fresnel(sun.y, kIorWater)) * sun.y * gather;
    }
    vec3 passed = wet ? exp(-absorption() * path) : vec3(1.0);
    return sunColour() * (free * max(facing, 0.0)) * passed;
}

// Lamps under water and lanterns on it, over pi.
vec3 lampsOn(vec3 p, vec3 nor, bool wet) {
    vec3 sum = vec3(0.0);
    if (poolLights > 0.0) {
        if (wet)
            for (int i = 0; i < 6; ++i) {
                vec3 to = lampPlace(i) - p;
                float r2 = dot(to, to) + 0.02, r = sqrt(r2);
                float facing = 0.15 + 0.85 * max(dot(to, nor) / r, 0.0);
                sum += exp(-absorption() * r) * (1.1 * facing / r2);
            } else {   // through the surface: as a glowing floor
            vec2 beyond = max(abs(p.xz) - kPool, 0.0);
            float near = 1.0 / (1.0 + 0.35 * square(p.y) + 2.0 * dot(beyond, beyond));
            sum += exp(-absorption() * 2.0) * (0.10 * (0.55 - 0.45 * nor.y) * near);
        }
        sum *= poolLights * vec3(0.85, 1.0, 0.95);
    }
    if (lanternGlow > 0.0)
        for (int i = 0; i < lanterns; ++i) {
            vec3 to = gLanterns[i].xyz - p;
            float r2 = dot(to, to) + 0.01;
            float facing = 0.1 + 0.9 * max(dot(to, nor) * inversesqrt(r2), 0.0);
            vec3 fade = wet ? exp(-absorption() * sqrt(r2)) : vec3(1.0);
            sum += lanternGlow * vec3(1.0, 0.55, 0.20) * fade * (0.05 * facing / r2);
        }
    return sum;
}

// Light scattered towards the eye along t metres of water: even, and closed-form round each lamp.
vec3 waterGlow(vec3 ro, vec3 rd, float t) {
    vec3 sigma = absorption();
    vec3 even = gAmbient + 0.25 * sunColour() * max(sin(radians(sunHeight)), 0.0);
    vec3 sum = vec3(0.010, 0.045, 0.05) * even * (1.0 - exp(-sigma * t)) / (sigma + 0.05);
    if (poolLights > 0.0)
        for (int i = 0; i < 6; ++i) {
            vec3 to = lampPlace(i) - ro;
            float mid = dot(to, rd), away = sqrt(max(dot(to, to) - mid * mid, 0.0) + 0.004);
            float arc = (atan((t - mid) / away) + atan(mid / away)) / away;
            sum += poolLights * 0.012 * arc * exp(-sigma * (max(mid, 0.0) + away));
        }
    return sum;
}

// ---- Materials ----------------------------------------------------------------------------------
// A tile is seen through moving water at any slant and size, so colours are means over the ray's
// footprint: joints by the integral of a line, tones that fade to their mean as tiles shrink.

// What mirrors, and how much. A path goes on with it.
vec3 shineOf(int id, float cosine, bool wet) {
    if (id == kBall) return mix(vec3(0.88, 0.87, 0.85), vec3(1.0), pow(1.0 - cosine, 5.0));
    if (id == kPaving) return vec3(0.25 * fresnel(cosine, 1.4));
    return vec3(id < kLantern ? 0.0 : fresnel(cosine, wet ? 1.1 : 1.45));
}

// Albedo of a matt thing; columns are fluted, which turns the normal.
vec3 albedoOf(Matt m, inout vec3 nor) {
    vec3 foot = min(abs(m.x) + abs(m.y), 50.0), p = m.pos;
    if (m.id == kColumn) {
        float a = atan(nor.x, nor.z + 1e-9);
        float distinct = clamp(1.0 - length(foot.xz) / kShaft * 3.2, 0.0, 1.0);
        nor.xz = turn(nor.xz, 0.45 * distinct * sin(20.0 * a));
        return vec3(0.72, 0.68, 0.62) * (0.93 + 0.07 * distinct * cos(20.0 * a));
    }
    if (m.id >= kLantern) {
        float red = step(0.55, random3(ivec3(m.id, 4, 4)).x);
        red *= 1.0 - smoothstep(0.0, 0.2, lanternGlow);
        return mix(vec3(0.80, 0.76, 0.70), vec3(0.85, 0.20, 0.08), red);
    }
    if (m.id >= kStone) return m.id == kBall ? vec3(0.0) : vec3(0.66, 0.62, 0.56);
    // Tiles or slabs: in the plane across the normal's longest axis.
    vec3 n = abs(nor);
    bool slab = m.id == kPaving, level = n.y > 0.5;
    float size = slab ? 0.9 : tileSize;
    vec2 uv = (level ? p.xz : n.x > 0.5 ? p.zy : p.xy) / size;
    vec2 w = (level ? foot.xz : n.x > 0.5 ? foot.zy : foot.xy) / size, c = floor(uv);
    vec3 r = random3(ivec3(ivec2(c), level ? 5 : 6));
    float distinct = clamp(1.5 - max(w.x, w.y), 0.0, 1.0), thin = slab ? 0.006 : 0.035;
    float joint = max(lines(uv.x, thin, w.x), lines(uv.y, thin, w.y));
    vec2 edge = abs(p.xz) - kPool;
    if (slab) {
        distinct *= step(0.45, max(edge.x, edge.y));   // the coping is one stone
        return vec3(0.58, 0.51, 0.43) * mix(1.0, 0.86 + 0.28 * r.x, distinct) * (1.0 - 0.6 * joint);
    }
    vec3 tint = linearColour(tileColour) * mix(1.0, 0.70 + 0.60 * r.x, distinct);
    vec3 accent = linearColour(tileColour) * vec3(0.35, 0.72, 0.95);
    tint = mix(tint, accent, mix(0.16, step(0.84, r.y), distinct));
    tint = mix(tint, 0.35 * linearColour(tileColour) + 0.34, joint);
    edge += 0.62;   // a dark band near the rim of the floor, one along the waterline, the coping
    float band = max(stripe(edge.x, -0.07, 0.07, foot.x) * step(edge.y, 0.07),
                     stripe(edge.y, -0.07, 0.07, foot.z) * step(edge.x, 0.07));
    if (m.id == kFloor) tint *= mix(vec3(1.0), vec3(0.16, 0.30, 0.45), band);
    if (m.id == kWall) {
        tint *= mix(vec3(1.0), vec3(0.10, 0.22, 0.40), stripe(p.y, -0.26, 0.02, foot.y));
        tint = mix(tint, vec3(0.60, 0.55, 0.48), stripe(p.y, 0.02, 1.0, foot.y));
    }
    return tint;
}

// Light that a matt point sends on.
vec3 lightFrom(Matt m) {
    vec3 nor = m.nor, albedo = albedoOf(m, nor), start = liftOff(m.pos, m.nor), own = vec3(0.0);
    float corner = 1.0;
    if (m.id == kFloor || m.id == kWall) {   // less sky in the corners
        vec3 room = vec3(kPool - abs(m.pos.xz), m.pos.y + depth).xzy + 0.15;
        vec3 shut = 1.0 - 0.35 * exp(-2.5 * room) * (1.0 - abs(m.nor));
        corner = shut.x * shut.y * shut.z;
    }
    vec3 open = gAmbient * (0.62 + 0.38 * nor.y) * corner;
    if (!m.wet) {   // the lit pool shines up at what stands over it
        vec2 beyond = max(abs(m.pos.xz) - kPool, 0.0);
        float far2 = 0.2 * square(m.pos.y) + 2.0 * dot(beyond, beyond);
        vec3 up = 0.6 * max(sin(radians(sunHeight)), 0.0) * sunColour() + gAmbient;
        up *= exp(-2.0 * depth * absorption()) * linearColour(tileColour);
        open += 0.16 * (1.0 - nor.y) / (1.0 + far2) * up;
    }
    if (m.wet) open *= 0.93 * exp(-1.2 * absorption() * max(-m.pos.y, 0.0));
    if (m.id == kWall && poolLights > 0.0)
        for (int i = 0; i < 6; ++i)
            own += (1.0 - smoothstep(0.09, 0.13, distance(m.pos, lampPlace(i)))) * poolLights * 9.0;
    if (m.id >= kLantern)
        own = lanternGlow * vec3(1.0, 0.46, 0.13) * (0.2 + m.cosine * m.cosine);
    return own + albedo * (open + sunOn(start, nor, m.wet) + lampsOn(start, nor, m.wet));
}

// ---- Transport ----------------------------------------------------------------------------------
// A ray carries its derivatives by the pixel's x and y: ox, oy (of its start) and dx, dy (of its
// direction), and every mirror and every bend changes them by the derivative of its own formula
// (Igehy). So at the end of any path its footprint is known: |ox + t dx| is as wide as one pixel.
// At water a path splits; the refracted ray goes on first, the mirrored one waits in a queue of
// one.

// A ray's differentials where it meets the plane of normal nor after t.
void landAt(inout Ray r, float t, vec3 nor) {
    float slope = dot(r.d, nor);
    if (abs(slope) < 0.02) slope = slope < 0.0 ? -0.02 : 0.02;   // a pixel 50 times as long
    r.ox += t * r.dx;
    r.oy += t * r.dy;
    r.ox = clamp(r.ox - dot(r.ox, nor) / slope * r.d, -9.0, 9.0);
    r.oy = clamp(r.oy - dot(r.oy, nor) / slope * r.d, -9.0, 9.0);
    r.o += t * r.d;
}
void reflectRay(inout Ray r, vec3 nor, vec3 nx, vec3 ny) {   // nx, ny: change of the normal
    float c = dot(r.d, nor);
    r.dx -= 2.0 * (c * nx + (dot(r.dx, nor) + dot(r.d, nx)) * nor);
    r.dy -= 2.0 * (c * ny + (dot(r.dy, nor) + dot(r.d, ny)) * nor);
    r.d -= 2.0 * c * nor;
    r.dx = clamp(r.dx, -2.0, 2.0);
    r.dy = clamp(r.dy, -2.0, 2.0);
}
// False for total reflection. eta: index before over index beyond. cosT without cancellation.
bool refractRay(inout Ray r, vec3 nor, vec3 nx, vec3 ny, float eta) {
    float cosI = -dot(r.d, nor), k = (1.0 - eta) * (1.0 + eta) + square(eta * cosI);
    if (k <= 0.0) return false;
    float cosT = sqrt(k), m = eta * cosI - cosT;
    float dm = eta - eta * eta * cosI / max(cosT, 0.05);   // of m, by cosI
    r.dx = clamp(eta * r.dx + m * nx - dm * (dot(r.dx, nor) + dot(r.d, nx)) * nor, -2.0, 2.0);
    r.dy = clamp(eta * r.dy + m * ny - dm * (dot(r.dy, nor) + dot(r.d, ny)) * nor, -2.0, 2.0);
    r.d = normalize(eta * r.d + m * nor);
    return true;
}
float coneOf(Ray r) { return sqrt(0.5 * (dot(r.dx, r.dx) + dot(r.dy, r.dy)) + r.rough); }

// Where a ray meets the water before h: the waves, or for planar pictures the plane.
float meetWater(Ray r, Hit h, bool level, float side) {
    int count;   // of no interest here
    float t = h.t;
    if (!level) {
        t = min(t, marchWater(r.o, r.d, h.t, r.wet, count));
    } else if (side * r.d.y < 0.0) {
        float down = -r.o.y * safeInverse(r.d).y;
        vec2 p = abs(r.o.xz + down * r.d.xz);
        if (down > 0.0 && down < h.t && p.x < kPool.x && p.y < kPool.y) t = down;
    }
    return t;
}
// The mean slope of what a view along d sees of slopes that have this mean and a variance on each
// axis that the pixel has lost: what faces away is hidden, so it leans towards the eye (Bruneton,
// Neyret, Holzschuch, CGF 29 (2010), with the logistic function for the Gaussian one).
vec2 seenSlope(vec2 slope, float lost, vec3 d, float side) {
    float deviation = max(sqrt(lost) * length(d.xz), 1e-6);
    float q = clamp(side * (dot(slope, d.xz) - d.y) / deviation, -4.0, 20.0);
    float ahead = 1.0 / (1.0 + exp(-1.702 * q));
    float area = deviation * (max(q, 0.0) + log(1.0 + exp(-1.702 * abs(q))) / 1.702);
    return slope + side * lost * (ahead / area) * d.xz;
}
// The water's normal at the ray's start, and how it changes over the pixel. What waves the pixel
// hides makes the ray rough: a mirrored ray turns by twice the slope, so its spread is 4 times
// that.
void waterNormal(inout Ray r, float side, out vec3 nor, out vec3 nx, out vec3 ny) {
    vec2 slope;
    vec3 second;
    float lost = waterShape(r.o.xz, r.ox.xz, r.oy.xz, slope, second);
    r.rough += 4.0 * lost;
    slope = seenSlope(slope, lost, r.d, side);
    float scale = side * inversesqrt(1.0 + dot(slope, slope));
    nor = scale * vec3(-slope.x, 1.0, -slope.y);
    nx = -scale * vec3(dot(second.xy, r.ox.xz), 0.0, dot(second.yz, r.ox.xz));
    ny = -scale * vec3(dot(second.xy, r.oy.xz), 0.0, dot(second.yz, r.oy.xz));
}

// One leg of a path: to what the ray meets, and on from there. sum: gains what shines on the leg.
// later: the mirrored ray, where the refracted one goes on. True where a matt point, m, is met.
bool followLeg(inout Ray r, inout Ray later, bool level, inout float reach, inout vec3 sum,
               out Matt m) {
    Hit h = intersect(r.o, r.d, r.wet);
    float side = r.wet ? -1.0 : 1.0, t = meetWater(r, h, level, side);
    bool onWater = t < h.t;
    if (reach < 0.0) reach = t;
    if (r.wet) {
        sum += r.carry * waterGlow(r.o, r.d, min(t, 50.0));
        r.carry *= exp(-absorption() * min(t, 50.0));
    }
    if (!onWater && h.id == kSky) {
        sum += r.carry * background(r.d, coneOf(r));
        r.carry = vec3(0.0);
    }
    vec3 nor = onWater ? vec3(0.0, side, 0.0) : h.nor, nx = vec3(0.0), ny = vec3(0.0);
    if (onWater || h.id != kSky) landAt(r, t, nor);
    // t is off by its last bits: a ray from the ball would meet the ball again.
    if (!onWater && h.id != kSky) r.o += 1e-6 * t * nor;
    if (onWater && !level) waterNormal(r, side, nor, nx, ny);
    float cosine = clamp(-dot(r.d, nor), onWater ? 1e-3 : 0.0, 1.0);
    vec3 share = vec3(fresnel(cosine, r.wet ? 1.0 / kIorWater : kIorWater));
    bool matt = !onWater && h.id != kSky && h.id != kBall;
    if (!onWater) {
        share = shineOf(h.id, cosine, r.wet);
        float bent = h.id == kBall ? 1.0 / kBallPlace.w : h.id >= kLantern ? 6.0 : 0.0;
        nx = bent * r.ox;
        ny = bent * r.oy;
    }
    m = Matt(r.o, nor, r.ox, r.oy, r.carry * (1.0 - share), cosine, h.id, r.wet);
    if (!onWater && h.id == kPaving) r.rough += 0.01;
    Ray on = r;
    reflectRay(r, nor, nx, ny);
    r.d = normalize(r.d + max(0.002 - dot(r.d, nor), 0.0) * nor);   // up from the surface
    r.carry *= share;
    r.o = onWater ? r.o + vec3(0.0, 2e-4 * side, 0.0) : liftOff(r.o, nor);
    if (onWater && refractRay(on, nor, nx, ny, on.wet ? kIorWater : 1.0 / kIorWater)) {
        on.o.y -= 2e-4 * side;
        on.wet = !on.wet;
        on.carry *= 1.0 - share;
        if (maxComponent(r.carry) > maxComponent(later.carry)) later = r;
        r = on;
    }
    return matt;
}

// Light that arrives against a ray. level: the water is a plane, for planar pictures. reach: the
// distance to what is met first. First come the paths of light, then the matt points on them, two
// at a time, so that pixels which are drawn together light them together.
vec3 render(Ray r, bool level, out float reach) {
    vec3 sum = vec3(0.0);
    Ray later = r;
    later.carry = vec3(0.0);
    reach = -1.0;
    bool alive = true;
    for (int k = 0; k < rays && alive;) {
        Matt here, next, met;
        here.carry = vec3(0.0);
        next.carry = vec3(0.0);
        int points = 0;
        for (; k < rays && alive && points < 2; ++k) {
            if (followLeg(r, later, level, reach, sum, met)) {
                if (points == 0) here = met;
                else next = met;
                ++points;
            }
            if (maxComponent(r.carry) < kLeastCarry) {
                alive = maxComponent(later.carry) >= kLeastCarry;
                r = later;
                later.carry = vec3(0.0);
            }
        }
        for (; points > 0; --points) {
            sum += here.carry * lightFrom(here);
            here = next;
        }
    }
    return sum;
}

// ---- Camera and planar pictures -----------------------------------------------------------------
// The eye goes round a point of the pool. A ray's direction is v / |v|; its derivatives follow by
// the quotient rule.

// The eye, and right, up and forward as columns. size: of the picture, pixels.
mat3 cameraFrame(vec2 size, out vec3 ro) {
    vec2 drag = mouse == 0 ? (iMouse.xy - abs(iMouse.zw)) / size : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * drag.x;
    vec3 target = vec3(targetX, targetHeight, targetZ);
    ro = target + cameraDistance * vec3(sin(angle), 0.0, cos(angle));
    ro.y = clamp(cameraHeight - 4.0 * drag.y, 0.3, 8.0);
    if (columns)
        for (int i = 0; i < 6; ++i) {   // not from inside a column
            vec2 away = ro.xz - columnPlace(i) + 1e-4;   // somewhere from the very middle
            ro.xz += away * max(0.55 * inversesqrt(dot(away, away) + 1e-12) - 1.0, 0.0);
        }
    if (mirrorBall) {                   // nor from inside the ball
        vec3 away = ro - kBallPlace.xyz;   // it is lower than the eye
        ro += away * max((kBallPlace.w + 0.1) * inversesqrt(dot(away, away)) - 1.0, 0.0);
    }
    vec3 forward = normalize(target - ro + vec3(0.0, 0.0, -1e-4));
    // The terrace has no outer sides: the eye stays above it, or above the pool.
    ro.xz = clamp(ro.xz, vec2(0.5 - kTerrace, 0.5 - kPool.y), vec2(kTerrace - 0.5));
    vec3 right = normalize(cross(forward, vec3(0.0, 1.0, 1e-5)));
    return mat3(right, cross(right, forward), forward);
}
float lens() { return focalLength / 24.0; }

Ray camera(vec2 at, vec2 size) {
    Ray r;
    mat3 frame = cameraFrame(size, r.o);
    vec2 uv = (at - 0.5 * size) / size.y;
    vec3 v = frame * vec3(uv, lens());
    float scale = inversesqrt(dot(v, v));
    r.d = v * scale;
    r.dx = (frame[0] - dot(frame[0], r.d) * r.d) * (scale / size.y);
    r.dy = (frame[1] - dot(frame[1], r.d) * r.d) * (scale / size.y);
    r.ox = vec3(0.0);
    r.oy = vec3(0.0);
    r.carry = vec3(1.0);
    r.rough = 0.0;
    r.wet = false;
    return r;
}

// The classic way, for comparison: a flat mirror shows the picture of a camera turned upside down
// below it, a flat refractor that of a camera which sees the bottom raised. Waves shift what is
// looked up in them. A slope s turns a mirrored ray by 2 s, so over the distance d to what is seen
// it shifts by 2 s d: d stands in the picture's alpha, and at a waterline it is 0.

const vec3 kUp = vec3(0.0, 1.0, 0.0);

vec4 planarPicture(vec2 pixel, bool under) {
    if (water != 0) return vec4(0.0);
    loadAll();
    vec2 size = iResolution.xy;
    Ray r = camera((pixel - 0.5 * size) * kMargin + 0.5 * size, size);
    if (r.d.y > -1e-4) return vec4(0.0);
    landAt(r, -r.o.y / r.d.y, kUp);
    r.o.xz = clamp(r.o.xz, 1e-3 - kPool, kPool - 1e-3);
    if (under) refractRay(r, kUp, vec3(0.0), vec3(0.0), 1.0 / kIorWater);
    else reflectRay(r, kUp, vec3(0.0), vec3(0.0));
    r.o.y = under ? -2e-4 : 2e-4;
    r.wet = under;
    gSunDisc = under;
    float reach;
    vec3 light = render(r, true, reach);
    return vec4(light, min(reach, 1e4));
}
// Where a point is in such a picture.
vec2 pictureUv(vec3 p) {
    vec3 ro, v;
    vec2 size = iResolution.xy;
    mat3 frame = cameraFrame(size, ro);
    v = (p - ro) * frame;
    return v.xy / max(v.z, 1e-3) * lens() * size.y / size / kMargin + 0.5;
}

// The water at t along a ray, from the two pictures. How far a slope moves what is seen depends on
// the distance beyond the water, twice looked up: at a waterline it is 0, so nothing smears there.
vec3 planarWater(Ray r, float t) {
    vec3 ro = r.o, rd = r.d;
    landAt(r, t, kUp);
    float texel = 2.0 * kPool.x / 256.0;
    float wide = max(length(r.ox.xz), length(r.oy.xz)), lod = log2(max(wide / texel, 1.0));
    vec4 ripple = textureLod(dudv, pondUv(r.o.xz), lod);
    vec3 nor = normalize(vec3(-ripple.x, 1.0, -ripple.y));
    float cosI = clamp(-dot(rd, nor), 1e-3, 1.0), share = fresnel(cosI, kIorWater);
    vec3 back = reflect(rd, nor), on = refract(rd, nor, 1.0 / kIorWater);
    back = normalize(vec3(back.x, max(back.y, 0.002), back.z));
    vec2 here = pictureUv(r.o), at = here;
    float far = kFar;
    for (int i = 0; i < 2; ++i) {
        far = min(far, textureLod(mirror, at, 0.0).w);
        at = pictureUv((r.o + far * back) * vec3(1, -1, 1));
    }
    vec3 sum = share * textureLod(mirror, at, 0.0).rgb;
    float spread = dot(r.dx, r.dx) + 4.0 * max(ripple.z - dot(ripple.xy, ripple.xy), 0.0);
    if (far > 9e3) sum += share * skyLight(back, 0.0).a * sunGlint(back, sqrt(spread));

    vec3 level = refract(rd, kUp, 1.0 / kIorWater);
    vec2 along = normalize(rd.xz + vec2(0.0, 1e-6)), across = vec2(-along.y, along.x);
    float tanI = length(rd.xz) / -rd.y, tanT = length(level.xz) / -level.y, deep = kFar;
    float bend3 = pow(rd.y / level.y, 3.0) / kIorWater;
    at = here;
    for (int i = 0; i < 2; ++i) {
        deep = min(deep, textureLod(below, at, 0.0).w * -level.y);
        vec2 moved = deep * (on.xz / min(on.y, -0.05) - level.xz / level.y) * -1.0;
        float radial = 1.0 / (1.0 + deep / ro.y * bend3);
        float round_ = ro.y * tanI / max(ro.y * tanI + deep * tanT, 1e-6);
        vec2 shift = along * (dot(moved, along) * radial) + across * (dot(moved, across) * round_);
        at = pictureUv(r.o + vec3(shift.x, 0.0, shift.y));
    }
    return sum + (1.0 - share) * textureLod(below, at, 0.0).rgb;
}

// ---- Passes -------------------------------------------------------------------------------------
// The simulation is the wave equation h'' = c^2 (h_xx + h_zz) on a grid, stepped 240 times a
// second: stable as long as a wave crosses less than 0.7 of a cell a step (Courant, Friedrichs,
// Lewy). Then what the picture wants of it: slopes, second derivatives, and how steep and high each
// patch can be.

// Single scattering in clear and hazy air, by the angle to the sun's bearing and the height.
void mainAir(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    vec3 sun = towardsSun(), sunward = vec3(0.0, sun.y, -sqrt(max(1.0 - sun.y * sun.y, 0.0)));
    float v = min(uv.y / (1.0 - 0.5 / iResolution.y), 1.0), up = v * v;
    float level = sqrt(1.0 - up * up), a = kPi * uv.x;
    vec3 rd = vec3(level * sin(a), up, -level * cos(a)), ro = vec3(0.0, 6360.3, 0.0);   // km
    vec3 rayleigh = vec3(5.8e-3, 13.5e-3, 33.1e-3), ozone = vec3(0.65e-3, 1.88e-3, 0.085e-3);
    float mie = 3.0e-3 * haze, mu = dot(rd, sunward), g = 0.76;
    float end = -ro.y * rd.y + sqrt(square(ro.y * rd.y) + square(6440.0) - ro.y * ro.y);
    vec3 sum = vec3(0.0), seen = vec3(0.0);
    for (int i = 0; i < 32; ++i) {
        float t0 = end * square(float(i) / 32.0), t1 = end * square(float(i + 1) / 32.0);
        vec3 p = ro + 0.5 * (t0 + t1) * rd;
        float r = length(p), h = r - 6360.0, toSun = dot(p, sunward);
        vec2 dense = exp(-h / vec2(8.0, 1.2));
        vec3 loss = rayleigh * dense.x + 1.1 * mie * dense.y
            + ozone * max(1.0 - abs(h - 25.0) / 15.0, 0.0);
        seen += 0.5 * (t1 - t0) * loss;
        float leave = -toSun + sqrt(toSun * toSun + square(6440.0) - r * r);
        vec3 shade = vec3(0.0);
        for (int j = 0; j < 8; ++j) {
            vec3 q = p + sunward * leave * (float(j) + 0.5) / 8.0;
            float hq = max(length(q) - 6360.0, 0.0);
            shade += rayleigh * exp(-hq / 8.0) + 1.1 * mie * exp(-hq / 1.2)
                + ozone * max(1.0 - abs(hq - 25.0) / 15.0, 0.0);
        }
        float lit = toSun > 0.0 ? 1.0
            : smoothstep(-6.0, 6.0, sqrt(max(r * r - toSun * toSun, 0.0)) - 6360.0);
        float hg = (1.0 - g * g) / (4.0 * kPi * pow(1.0 + g * g - 2.0 * g * mu, 1.5));
        vec3 phase = rayleigh * dense.x * (3.0 / (16.0 * kPi) * (1.0 + mu * mu));
        // biased: an even share stands for light scattered more than once
        phase += mie * dense.y * hg + (rayleigh * dense.x + mie * dense.y) * 0.025;
        sum += (t1 - t0) * lit * phase * exp(-seen - shade * leave / 8.0);
        seen += 0.5 * (t1 - t0) * loss;
    }
    colour = vec4(31.4 * sum, 1.0);   // the sun's 10 x pi
}

float tiledNoise(vec2 unit, ivec2 period, int seed) {   // value noise on a torus
    vec2 p = unit * vec2(period), f = fract(p), s = f * f * (3.0 - 2.0 * f);
    ivec2 a = ivec2(p) % period, b = (a + 1) % period;   // unit in [0, 1)
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}

float ridge(float turns, int seed) {   // smooth noise round the horizon
    float x = turns * 48.0, i = floor(x), f = x - i, s = f * f * (3.0 - 2.0 * f);
    ivec2 c = (ivec2(int(i)) + ivec2(0, 1) + 96) % 48;
    return mix(random3(ivec3(c.x, seed, 3)).x, random3(ivec3(c.y, seed, 3)).x, s);
}

// Noise on a plane, drawn out along the wind. Above: thin clouds on a flat layer, 0 to 1, whose
// octaves curl. Below (v < 0): streaks on the sea where wind roughens it, -0.5 to 0.5; an octave
// fades as a row of the picture, dv of v, comes to span its cells.
float alongWind(vec3 rd, float v) {
    bool sea = v < 0.0;
    float up = v * v, weight = 0.5, sum = 0.0, dv = 2.0 / iResolution.y;
    // Wider round the zenith, where all columns of the picture meet in a point.
    float wide = 1.0 - exp(-40.0 * (1.0 - up * up));
    vec2 q = turn(rd.xz * wide / (up + 0.10), 0.5) * vec2(0.030, 0.075) + 0.5;
    if (sea) q = turn(rd.xz / (up + 0.004), 0.9) * vec2(0.013, 0.060) + 0.5;
    float row = sea ? 0.055 * 2.0 * abs(v) * dv / square(up + 0.004) : 0.0;
    for (int i = 0; i < 6; ++i) {
        float keep = clamp(1.4 - row * float(6 << i), 0.0, 1.0);
        float noise = tiledNoise(min(fract(q), 0.999999), ivec2(6) << i, (sea ? 50 : 20) + i);
        sum += weight * keep * (sea ? noise - 0.5 : noise);
        q += (sea ? 0.04 : 0.05) * sum;
        weight *= sea ? 0.8 : 0.55;
    }
    return sum;
}
// The sea beyond the pool. It is rough, so it mirrors what stands higher; it glitters, and where
// one looks down into it the blue of deep water comes up. up: the depression's sine; turned: from
// the sun, in half turns.
vec3 farSea(vec3 rd, float up, float streak, float turned, vec3 sun, vec3 night) {
    vec3 above = texture(air, vec2(turned, sqrt(min(up + 0.16, 1.0)))).rgb + night;
    float mirrored = (0.12 + 0.55 * exp(-9.0 * up)) * (1.0 + 2.2 * streak);
    vec3 light = above * mirrored;
    vec3 down = sunColour() * max(sun.y, 0.0) + texture(air, vec2(turned, 0.75)).rgb;
    light += down * vec3(0.008, 0.060, 0.085) * (1.0 - exp(-6.0 * up)) * (1.0 - 1.1 * streak);
    light += sunColour() * vec3(0.0003, 0.001, 0.0014);
    vec2 off = normalize(rd.xz + 1e-6) - normalize(sun.xz + 1e-6);
    light += 0.55 * sunColour() * (1.0 + 1.6 * streak)
        * exp(-dot(off, off) / (0.010 + 0.6 * up * up)
              - 60.0 * square(0.02 + 0.16 * max(sun.y, 0.0) - up));
    vec3 mist = texture(air, vec2(turned, 0.1)).rgb + night;
    return mix(mist, light, exp(-kEyeLevel / max(up, 1e-4) / 9000.0));
}
// All round: sky, thin clouds, headlands, the sea below.
void mainSky(out vec4 colour, in vec2 pixel) {
    vec2 uv = pixel / iResolution.xy;
    vec3 sun = towardsSun();
    float a = 2.0 * kPi * (uv.x - 0.5), v = (2.0 * uv.y - 1.0) / (1.0 - 1.0 / iResolution.y);
    float up = min(v * v, 1.0);
    vec3 rd = vec3(sqrt(1.0 - up * up) * sin(a), up, -sqrt(1.0 - up * up) * cos(a));
    float turned = abs(fract((a - radians(sunAngle)) / (2.0 * kPi) + 0.5) - 0.5) * 2.0;
    vec3 night = vec3(0.0010, 0.0019, 0.0052);   // airglow and what scatters twice
    vec3 light = texture(air, vec2(turned, abs(v) * (1.0 - 0.5 / 128.0))).rgb + night;
    float drawn = alongWind(rd, v), sum = v < 0.0 ? 0.0 : drawn;
    float cover = mix(0.85, 0.35, clouds), thick = smoothstep(cover, cover + 0.38, sum);
    thick *= smoothstep(0.0, 0.10, up) * step(0.001, clouds);
    float towards = max(dot(rd, normalize(vec3(sun.x, max(sun.y, 0.0), sun.z))), 0.0);
    vec3 lit = sunColour() * (0.05 + 0.10 * pow(towards, 4.0) + 0.35 * pow(towards, 40.0));
    // What lies low all round lights the clouds high up, not what lies low below them.
    float aside = mix(turned, 0.5, min(2.0 * up, 1.0));
    vec3 around = 0.9 * texture(air, vec2(aside, 0.75)).rgb
        + 0.25 * texture(air, vec2(aside, 0.2)).rgb + night;
    light = mix(light, around + lit * (1.0 - 0.55 * thick), 0.85 * thick);
    float shore = smoothstep(0.04, 0.12, abs(uv.x - 0.5));
    // Higher up there is none; whole quads agree, for there are derivatives below.
    float rows = 2.0 * (2.0 * floor(0.5 * pixel.y) + 1.0) / iResolution.y - 1.0, land = 0.0;
    for (int i = 0; i < (square(rows) < 0.14 ? 2 : 0); ++i)
        land += (i == 0 ? 0.095 : 0.03) * ridge(fract(uv.x * (i == 0 ? 1.0 : 3.0)), 1 + i);
    land *= shore;
    // A texel is far wider than high: a steep edge is as soft as it is wide, or large pictures show
    // its steps.
    float over = land - up, soft = max(fwidth(over), 0.0015), hills = smoothstep(-soft, soft, over);
    vec3 far = light * mix(vec3(0.20, 0.24, 0.32), vec3(1.0), 0.35);
    light = mix(light, far, hills);
    if (v < 0.0) {
        vec3 distant = farSea(rd, up, drawn, turned, sun, night);
        light = mix(distant, far, 0.5 * hills * exp(-30.0 * up));
    }
    colour = vec4(min(light, 6e4), step(0.0, v) * (1.0 - hills) * (1.0 - 0.8 * thick));
}

// The plane waves, four to a group: kx, kz (rad/m), height (m), phase (rad).
void mainWavelets(out vec4 colour, in vec2 pixel) {
    int group = int(pixel.x) >> 2, kind = int(pixel.x) & 3;
    float highest = min(waveHeight, longestWave / 14.0);   // steeper ones break (Stokes 1880)
    float total = 0.0;
    for (int i = 0; i < 8; ++i) total += pow(0.74, 1.2 * float(i));
    for (int c = 0; c < 4; ++c) {
        float i = float(group * 4 + c);
        float aside = 2.0 * fract(i * 0.61803399 + 0.5) - 1.0;
        float a = radians(windAngle + windSpread * aside);
        float k = 2.0 * kPi / (longestWave * pow(0.74, i));
        float hz = sqrt(kGravity * k * tanh(min(k * depth, 20.0))) / (2.0 * kPi);
        float phase = 2.0 * kPi * (fract(i * 0.7548777) - cycles(hz));
        colour[c] = kind == 0 ? k * sin(a) : kind == 1 ? k * cos(a)
            : kind == 2 ? highest * pow(0.74, 1.2 * i) / total : phase;
    }
}

// Squared wave speed at a point: `waveSpeed` over deep water; 0 inside what stands there and beyond
// the walls.
float squaredSpeed(vec2 p) {
    if (abs(p.x) > kPool.x || abs(p.y) > kPool.y) return 0.0;
    float down = depth;
    if (columns)
        for (int i = 0; i < 6; ++i) {
            vec2 q = p - columnPlace(i);
            if (dot(q, q) < square(kFoot)) down = 0.0;
        }
    if (steps)
        for (int i = 3; i >= 0; --i)
            if (p.x > stepReach(i) && p.y > kStepsAlong.x && p.y < kStepsAlong.y)
                down = min(down, max(-stepTop(i), 0.0));
    if (mirrorBall && distance(p, kBallPlace.xz) < kBallPlace.w) down = 0.0;
    float c2 = waveSpeed * waveSpeed;
    return c2 * tanh(min(kGravity * down / c2, 20.0));
}
// A texel of the pond and of its bed is four cells in a row, west to east: what steps 240 times a
// second fetches half as much for a cell so. The middle of the first of them, m, and their size.
vec2 cellPlace(vec2 pixel, vec2 size) {
    return (vec2(4.0 * pixel.x - 1.5, pixel.y) / vec2(4.0 * size.x, size.y) - 0.5) * 2.0 * kPool;
}
float cellSize(float width) { return 2.0 * kPool.x / (4.0 * width); }

// Squared wave speed at the faces of four cells towards east and north: the harmonic mean of both
// sides, so that nothing passes into what is solid.
void mainBed(out vec4 east, out vec4 north, in vec2 pixel) {
    vec2 size = iResolution.xy, first = cellPlace(pixel, size);
    float cell = cellSize(size.x), before = 0.0;
    for (int i = 0; i < 5; ++i) {
        vec2 p = first + vec2(float(i) * cell, 0.0);
        float here = squaredSpeed(p);
        if (i > 0) east[i - 1] = 2.0 * before * here / max(before + here, 1e-9);
        before = here;
        if (i == 4) break;
        float beyond = squaredSpeed(p + vec2(0.0, cell));
        north[i] = 2.0 * here * beyond / max(here + beyond, 1e-9);
    }
}

vec4 previousFrame(vec4 p) {   // NaN compares false
    return mix(vec4(0.0), p, lessThanEqual(abs(p), vec4(6e4)));
}

// Small buffers know by it how large the picture is, in whose pixels the mouse counts. Drawn once.
void mainScreen(out vec4 colour, in vec2 pixel) { colour = vec4(0.0); }

// What pushes the water in this step. 0: where the mouse presses, now (xy) and a step ago (zw);
// 1000 for nowhere. 1: a drop, its place (xy), radius and force; 0 for none.
void mainPushes(out vec4 colour, in vec2 pixel) {
    if (pixel.x > 1.0) {
        vec3 r = random3(ivec3(int(iTick), 17, 5)), s = random3(ivec3(int(iTick), 29, 7));
        colour = vec4((2.0 * r.xy - 1.0) * kPool, dropSize * (0.8 + 0.5 * s.x),
                      r.z < rain * iTimeDelta ? dropForce * (0.3 + 0.9 * s.y) : 0.0);
        return;
    }
    vec4 old = previousFrame(texelFetch(pushes, ivec2(0), 0));
    bool pressed = iMouse.w > 0.0, held = iMouse.z > 0.0 && mouse == 1;
    vec2 at = vec2(1e3);
    if (pressed || held) {
        Ray r = camera(iMouse.xy, vec2(textureSize(screen, 0)));
        float t = r.d.y < -1e-3 ? -r.o.y / r.d.y : kFar;
        if (t < 60.0) at = r.o.xz + t * r.d.xz;
    }
    colour = vec4(at, old.x == 0.0 && old.y == 0.0 || old.x > 500.0 || pressed ? at : old.xy);
}

vec2 pondSize() { return vec2(textureSize(pond, 0)); }   // texels, of four cells each
// A texel that went bad is level water.
vec4 heightsAt(vec2 place) {
    return clamp(previousFrame(fetch(pond, place, pondSize())), -kCeiling, kCeiling);
}

vec4 only(int i) { return vec4(equal(ivec4(i), ivec4(0, 1, 2, 3))); }
// How hard the water is pushed apart, m2/s. By the gradient of exp(-r2/s2) it leaves the middle;
// the Laplacian of that is a dent and its rim.
float pushAt(vec2 p, vec4 hand, vec4 drop) {
    vec2 off = (p - drop.xy) / drop.z;
    float push = drop.w * square(drop.z) * exp(-min(dot(off, off), 80.0));
    if (hand.x < 500.0) {
        vec2 way = hand.xy - hand.zw, to = p - hand.zw;
        float along = clamp(dot(to, way) / max(dot(way, way), 1e-9), 0.0, 1.0);
        off = (to - along * way) / dropSize;
        float strength = dropForce * (mouse == 0 ? 1.0 : 8.0 * iTimeDelta);
        push += strength * square(dropSize) * exp(-min(dot(off, off), 80.0));
    }
    return 0.25 * push;
}

// What crosses a face in a step, as height of a cell (m), from the lower one (west, south) to the
// upper: kept is the last step's, drive what slopes and pushes add. Both cells reckon it alike, so
// what one loses the other gains. Waves break at the ceiling: a face takes at most a quarter of
// what its giver has left, or of what its taker has room for.
vec4 crossing(vec4 kept, vec4 drive, vec4 c2, vec4 lower, vec4 upper) {
    vec4 most = 0.25 * min(kCeiling + lower, kCeiling - upper);
    vec4 least = -0.25 * min(kCeiling + upper, kCeiling - lower);
    return mix(vec4(0.0), clamp(kept + drive, least, most), greaterThan(c2, vec4(0.0)));
}

// One step of the wave equation by what crosses the faces between cells: heights, and what went
// east and north half a step earlier. The water that there is stays, whatever pushes it. Kick, then
// drift: second order, stable to a Courant number of 0.7; the ranges end at 0.5.
void mainPond(out vec4 high, out vec4 wentEast, out vec4 wentNorth, in vec2 pixel) {
    ivec2 c = ivec2(pixel);   // beyond the rim the sampler has what stands at it
    vec2 size = pondSize(), own = floor(pixel), toWest = own - vec2(1.0, 0.0);
    vec2 toSouth = own - vec2(0.0, 1.0);
    float cell = cellSize(size.x);
    vec4 here = heightsAt(own), south = heightsAt(toSouth), north = heightsAt(own + vec2(0.0, 1.0));
    vec4 west = vec4(c.x > 0 ? heightsAt(toWest).w : here.x, here.xyz);
    vec4 east = vec4(here.yzw, float(c.x) < size.x - 1.0 ? heightsAt(own + vec2(1.0, 0.0)).x : here.w);
    vec4 c2East = fetch(bedEast, own, size), c2North = fetch(bedNorth, own, size);
    vec4 c2West = vec4(c.x > 0 ? fetch(bedEast, toWest, size).w : 0.0, c2East.xyz);
    vec4 c2South = c.y > 0 ? fetch(bedNorth, toSouth, size) : vec4(0.0);
    vec4 keptEast = previousFrame(fetch(pondEast, own, size));
    vec4 keptNorth = previousFrame(fetch(pondNorth, own, size));
    vec4 keptWest = vec4(previousFrame(fetch(pondEast, toWest, size)).w, keptEast.xyz);
    vec4 keptSouth = previousFrame(fetch(pondNorth, toSouth, size));
    vec4 hand = texelFetch(pushes, ivec2(0), 0), drop = texelFetch(pushes, ivec2(1, 0), 0);
    mat4 push = mat4(0.0);   // beyond the faces, less here: west, east, south, north
    int pushed = drop.w > 0.0 || hand.x < 500.0 ? 4 : -1;   // most steps leave it out
    for (int i = -1; i < pushed; ++i) {
        vec4 face = only(i), row;
        for (int k = 0; k < 4; ++k) {
            vec2 p = cellPlace(pixel, size) + cell * (vec2(k, 0) + face.yw - face.xz);
            row[k] = pushAt(p, hand, drop);
        }
        push += outerProduct(row, i < 0 ? vec4(-1.0) : face);
    }
    float kept = exp(-damping * iTimeDelta), weight = iTimeDelta * (1.0 + kept) * 0.5;
    float gain = iTimeDelta / (cell * cell);
    vec4 driveWest = (weight * c2West * (here - west) - push[0]) * gain;
    vec4 driveEast = (weight * c2East * (here - east) - push[1]) * gain;
    vec4 driveSouth = (weight * c2South * (here - south) - push[2]) * gain;
    vec4 driveNorth = (weight * c2North * (here - north) - push[3]) * gain;
    wentEast = crossing(kept * keptEast, driveEast, c2East, here, east);
    wentNorth = crossing(kept * keptNorth, driveNorth, c2North, here, north);
    high = here + (crossing(kept * keptWest, -driveWest, c2West, west, here) - wentEast
        + crossing(kept * keptSouth, -driveSouth, c2South, south, here) - wentNorth);
    // Inside what stands there: the water round it, continued.
    high = mix(high, 0.25 * (west + east + south + north),
                  equal(c2West + c2East + c2South + c2North, vec4(0.0)));
}

// The surface between the cells: a cubic B-spline of heights, for smooth derivatives. x height,
// y z slope; then second derivatives xx, xz, zz.
void mainRelief(out vec4 shape, out vec4 second, in vec2 pixel) {
    vec2 size = pondSize();
    int x = int(pixel.x), last = 4 * int(size.x) - 1;
    float cell = 2.0 * kPool.x / float(last + 1);
    int west = max(x - 1, 0), east = min(x + 1, last);   // no more than two texels of the pond
    vec4 pickWest = only(west & 3), pick = only(x & 3), pickEast = only(east & 3);
    vec3 h[3];
    for (int k = 0; k < 3; ++k) {
        float y = floor(pixel.y) + float(k - 1);
        vec4 left = fetch(pond, vec2(west >> 2, y), size);
        vec4 right = fetch(pond, vec2(east >> 2, y), size), own = (x & 3) == 0 ? right : left;
        h[k] = vec3(dot(left, pickWest), dot(own, pick), dot(right, pickEast));
    }
    vec3 a = h[0], b = h[1], d = h[2];
    vec3 row = (a + d + 4.0 * b) / 6.0, weight = vec3(1.0, 4.0, 1.0) / 6.0;
    vec3 column = vec3(dot(a, weight), dot(b, weight), dot(d, weight));
    shape.x = dot(row, weight);
    shape.yz = vec2(row.z - row.x, column.z - column.x) / (2.0 * cell);
    shape.w = 0.0;
    second = vec4(row.x - 2.0 * row.y + row.z, 0.25 * (d.z - d.x - a.z + a.x),
                  column.x - 2.0 * column.y + column.z, 0.0) / (cell * cell);
}
// Their heights alone: what rays march over is fetched many times, and so in half the time.
void mainHeights(out vec4 colour, in vec2 pixel) {
    colour = vec4(texelFetch(relief, ivec2(pixel), 0).x);
}
// Of what the filter makes of the heights of a patch: how high, how deep, how steep at most.
void mainPeaks(out vec4 colour, in vec2 pixel) {
    vec2 first = floor(pixel) * float(kCells), cells = vec2(textureSize(levels, 0));
    vec2 most = vec2(-1.0), steep = vec2(0.0);
    for (int j = -1; j <= kCells; ++j) {
        float here = fetch(levels, first + vec2(-1, j), cells).x;
        for (int i = -1; i <= kCells; ++i) {
            vec2 at = first + vec2(i, j);
            float east = fetch(levels, at + vec2(1.0, 0.0), cells).x;
            float north = fetch(levels, at + vec2(0.0, 1.0), cells).x;
            most = max(most, vec2(here, -here));
            steep = max(steep, abs(vec2(east, north) - here));
            here = east;
        }
    }
    colour = vec4(most, length(steep) * cells.x / (2.0 * kPool.x), 0.0);
}
void mainCrest(out vec4 colour, in vec2 pixel) {
    vec3 most = vec3(0.0);
    for (int j = 0; j < 48; ++j)
        for (int i = 0; i < 32; ++i)
            most = max(most, texelFetch(peaks, ivec2(i, j), 0).xyz);
    colour = vec4(max(most.x, most.y), most.z, 0.0, 0.0);
}

// The lanterns, each on a small round of its own, afloat: centre, radius.
void mainFloats(out vec4 colour, in vec2 pixel) {
    loadWaves();
    int k = int(pixel.x);
    vec3 r = random3(ivec3(k, 8, 3));
    vec2 home = vec2(k % 2 == 0 ? 1.15 : -1.3, 4.2 - 1.28 * float(k));
    home.x += (r.x - 0.5) * 0.5;
    float a = 2.0 * kPi * (r.y + cycles(0.015625) * (k % 3 == 0 ? -1.0 : 1.0));
    vec2 p = home + 0.16 * vec2(sin(a), cos(a));
    float radius = mix(0.13, 0.19, r.z), height = 0.0;
    for (int i = loopStart(); i < 4; ++i)   // it does not follow what is shorter than itself
        height += 0.25 * waterHeight(p + radius * vec2((i & 1) * 2 - 1, (i & 2) - 1));
    colour = vec4(p.x, height + 0.45 * radius, p.y, radius);
}

// The classic pictures, a little wider than the screen; w: distance to what they show. What is
// above the water, from an eye mirrored in it; what is below, bent by a level surface.
void mainMirror(out vec4 colour, in vec2 pixel) { colour = planarPicture(pixel, false); }
void mainBelow(out vec4 colour, in vec2 pixel) { colour = planarPicture(pixel, true); }

// Slopes over the pool and, for what a mipmap level hides, the square of their length.
void mainDudv(out vec4 colour, in vec2 pixel) {
    colour = vec4(0.0);
    if (water != 0) return;
    loadWaves();
    vec2 slope = waterSlope((pixel / iResolution.xy - 0.5) * 2.0 * kPool);
    colour = vec4(slope, dot(slope, slope), 1.0);
}

// ---- Image --------------------------------------------------------------------------------------
// Traced, a pixel is one path of light. Planar, all but the water is a path, too, and the water's
// pixels come from two pictures.

// Light to display: clamped first, then the largest channel rolls off, the others keep their ratio
// to it, with a little white at the top as on film; then sRGB. NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// What hides the bands of a smooth picture of 255 steps: half a step, up or down by chance. It is
// the same for all samples of a pixel: their mean is rounded, and of many none would be left.
vec3 dither(vec2 fragCoord) {
    vec3 chance = random3(ivec3(16 * ivec2(fragCoord) + 8, 3));
    return (chance + chance.yzx - 1.0) * (0.5 / 255.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    loadAll();
    vec3 sum = vec3(0.0);
    for (int i = 0; i < antialias; ++i) {   // the first in the middle of the pixel
        vec2 aside = fract(0.5 + float(i) * vec2(0.75487767, 0.56984029)) - 0.5;
        Ray r = camera(fragCoord + aside, iResolution.xy);
        float t = water == 0 && r.d.y < 0.0 ? -r.o.y * safeInverse(r.d).y : kFar, reach;
        vec2 p = abs(r.o.xz + min(t, 1e4) * r.d.xz);
        bool pooled = t < kFar && p.x < kPool.x && p.y < kPool.y;
        if (pooled) pooled = intersect(r.o, r.d, false).t > t;
        sum += pooled ? planarWater(r, t) : render(r, water == 0, reach);
    }
    fragColor = vec4(display(exp2(exposure) * sum / float(antialias)) + dither(fragCoord), 1.0);
}
