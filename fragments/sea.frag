// On the sea: two rabbits, a lifebuoy and a looking glass at the end of the day.
//
// Open water under a low sun. One rabbit rides in a lifebuoy, another swims with half of it under
// water, and an arched mirror stands in the sea. Water and mirror find what they show by walking
// the picture's own depth, or exactly, for comparison.
//
// Method   The sea is a height field of directional waves with exact phases; the eight long ones
//          move the surface, sixteen more tilt it. A wave that is finer than a pixel's footprint is
//          left out and its slope variance widens the sun's lobe instead, so nothing aliases. Rays
//          meet the sea by steps that its slope bounds, then Illinois steps. Rabbits are ellipsoids
//          in a smooth union whose field never exceeds the distance: a step cannot be too long.
//          Screen-space rays are clipped to what can be hit, to the near plane and to the picture,
//          and walked in pixels with depth interpolated in perspective. They know where the picture
//          does not tell: past the edge of a thing, or where they graze it. Those are traced.
// Sources  McGuire and Mara, JCGT 3(4) (2014): the line walk. Bruneton, Neyret, Holzschuch, CGF 29
//          (2010), and Ross, Dion, Potvin, JOSA A 22 (2005): glitter of a filtered sea. Cox and
//          Munk, JOSA 44 (1954): slopes. Nishita et al., SIGGRAPH (1993): single scattering.
//          Hart, Visual Computer 12 (1996): sphere tracing. Jarzynski and Olano, JCGT 9(3) (2020):
//          pcg3d. Born and Wolf, Principles of Optics, 1.5: Fresnel. Vogel (1979): phyllotaxis.
// Units    1 unit = 1 m, y up, linear colour; the sun gives kSunPower above the air.
// Passes   sky, ambient: on change of a tweak; screen: only its size counts. Every frame: poses
//          (tiny), albedo + normalDepth, lightBuffer, the picture.
// Bounds   Slopes of the long waves sum to 0.77 at most. The loops of a pixel stay below 12,000
//          turns with every reference on.
// Defaults From `glint study presets/sea.toml`: seaSteps 64 draw what 512 do; at 1.5 degrees 128
//          leave no more than 0.1 % of the rays out of steps in any sea. A cone of shadow is 4e-4
//          (RMSE) from 64 sampled rays in a third of the frame. Tracing all rays costs some 10 %
//          less than asking the picture first (llvmpipe traces eight pixels where one is in doubt);
//          the looking glass shows what the picture does not hold: presets that have one trace.
// Licence  MIT

// ---- Tweaks -------------------------------------------------------------------------------------
//@ group Sea
uniform float waveHeight;      //@ 1.0 [0, 2] "height of the long waves; 1 is a gentle breeze"
uniform float choppiness;      //@ 0.6 [0, 1] "sharpness of the crests"
uniform float ripples;         //@ 1.0 [0, 2] "steepness of the short waves"
uniform float windAngle;       //@ 60 [-180, 180] unit=deg "where the waves go; 0 is to the right"
uniform vec3  waterColour;     //@ #0d5a5c "what deep water scatters back"
uniform float clarity;         //@ 1.6 [0.2, 20] log unit=m "how far light goes in the water"
uniform float animation;       //@ 1.0 [0, 4] "speed of everything that moves"
//@ group Sky
uniform float sunHeight;       //@ 6.0 [0.5, 60] unit=deg "over the horizon"
uniform float sunAngle;        //@ -16 [-180, 180] unit=deg "0 is straight ahead of the camera's 0"
uniform float sunSize;         //@ 0.27 [0.1, 3] log unit=deg "radius of the sun's disc"
uniform float haze;            //@ 1.0 [0.1, 6] log "dust and moisture in the air"
uniform float clouds;          //@ 0.5 [0, 1] "share of the sky that they cover"
//@ group Things
uniform int   rabbits;         //@ 2 [0, 2] "one in the lifebuoy, one that swims"
uniform float rabbitAngle;     //@ 50 [-180, 180] unit=deg "where the rabbit in the lifebuoy looks"
uniform vec3  furColour;       //@ #f2e4d2 "of the rabbits"
uniform bool  mirror;          //@ on "a looking glass stands in the sea"
uniform float mirrorAngle;     //@ -64 [-180, 180] unit=deg "where it faces"
uniform float mirrorBlur;      //@ 0.0 [0, 0.2] unit=rad "half width of what the glass gathers"
//@ group Camera
uniform float cameraDistance;  //@ 3.9 [2, 12] unit=m "from the middle of the scene"
uniform float cameraAngle;     //@ 0 [-180, 180] unit=deg "round the scene"
uniform float cameraHeight;    //@ 1.15 [0.2, 6] unit=m "of the eye, and never inside a wave"
uniform float targetHeight;    //@ 0.55 [-1, 4] unit=m "of the point looked at"
uniform float targetShift;     //@ 0.0 [-3, 3] unit=m "of the point looked at, to the right"
uniform float focalLength;     //@ 33 [12, 120] log unit=mm "of a lens on 36 x 24 mm film"
uniform float exposure;        //@ 0.0 [-4, 4] unit=stop "before the display curve"
//@ group Reflections
uniform int   reflections; //@ 2 {off, march, screen-space, traced} quality reference=3 "of things"
uniform float stride;          //@ 3 [1, 16] unit=px quality reference=1 "of the line walk"
uniform float jitter;          //@ 0.0 [0, 1] "start of the walk, in strides, by chance"
uniform float thickness;       //@ 0.0 [0, 2] unit=m "of what a pixel shows; 0: as deep as it is"
uniform float bias;            //@ 0.002 [0, 0.2] unit=m "depth that a ray must pass a surface by"
uniform float edgeFade;        //@ 0.06 [0, 0.5] "share of the picture over which reflections fade"
//@ group Quality
uniform int   march;           //@ 0 {bounded, even} norandom "steps to the sea; even: to compare"
uniform int   seaSteps; //@ 128 [8, 512] log quality reference=512 second=march=even "of a ray to the sea"
uniform int   mirrorRays;      //@ 16 [1, 64] log quality reference=64 "where the mirror blurs"
uniform int   shadows;         //@ 1 {off, cone, sampled} quality reference=2 "kind of shadow"
uniform int   sunSamples;      //@ 16 [1, 64] log quality reference=64 "rays of a sampled shadow"

precision highp sampler2D;     // the default is lowp: Mesa then reads 32-bit buffers as halves
uniform sampler2D sky;         //@ pass mainSky size=256x128 format=rgba16f
uniform sampler2D ambient;     //@ pass mainAmbient size=8x1 format=rgba16f filter=nearest
uniform sampler2D screen;      //@ pass mainScreen format=r8
uniform sampler2D poses;       //@ pass mainPoses size=8x1 filter=nearest
uniform sampler2D albedo;      //@ pass mainGBuffer filter=nearest
uniform sampler2D normalDepth; //@ pass mainGBuffer filter=nearest
uniform sampler2D smoothDepth; //@ buffer normalDepth filter=linear
uniform sampler2D lightBuffer; //@ pass mainLight format=rgba16f filter=nearest

// ---- Constants and numbers ----------------------------------------------------------------------
// The sun gives kSunPower above the air; sky and all else follow from that. Waves are a table:
// groups of four, so that a vec4 holds a group and one instruction works on all of it.

const float kPi = 3.14159265358979;
const float kGolden = 0.61803398874989;    // turns between neighbours of a phyllotaxis
const float kFar = 1e9;                    // m, a miss
const float kGravity = 9.81;               // m/s^2
const float kIorWater = 1.333;             // visible light, 20 C
const vec3  kSunPower = vec3(20.0);        // above the air, on a surface that faces it
const float kCalmSpread = 0.0009;          // slope variance of capillary waves, always unresolved
const vec3  kAbsorption = vec3(1.9, 0.75, 0.65);   // of water, times 1 / clarity
const float kEarth = 6.36e6, kAir = 6e4;   // m, radius and height of the air
const vec3  kRayleigh = vec3(5.8e-6, 13.5e-6, 33.1e-6);   // 1/m at sea level
const vec3  kOzone = vec3(0.65e-6, 1.88e-6, 0.085e-6);    // 1/m at 25 km
const float kMie = 4e-6;                   // 1/m at sea level and haze 1
const float kNear = 0.05;                  // m, depth of the near plane of screen-space rays
const int   kSky = 0, kWater = 1, kGlass = 2, kGilt = 3, kRing = 4, kFur = 5, kBack = 6;
const float kGlow = 1.5;                   // of crests before the sun
const float kRim = 1.0;                    // of fur before the sun
const float kSeenDeep = 6.0;               // m, along a ray, that things are seen through water
const int   kTraceSteps = 72;              // for one cluster of things
const vec3  kMirrorAt = vec3(1.12, 0.0, 0.35);           // m
const float kBevel = 0.10;                 // m, the ground edge of the glass, half under the frame
const float kArch = 0.52, kSpring = 1.12, kTube = 0.045;  // m: half width, where it bends, frame
// Waves: numbers 1/m in the wind's frame, long to short, and steepness.
const vec4 kWaveX[6] = vec4[6](
    vec4(0.2957, 0.4405, 0.7218, 1.0783), vec4(1.6993, 2.7718, 3.6265, 6.6727),
    vec4(8.9873, 9.9369, 13.4758, 13.1480), vec4(17.9752, 21.8698, 19.2172, 31.9144),
    vec4(32.0328, 37.8205, 53.5999, 37.8046), vec4(72.3029, 80.7237, 67.5113, 129.2947));
const vec4 kWaveZ[6] = vec4[6](
    vec4(-0.0458, 0.1606, 0.0236, -0.3772), vec4(0.4948, -0.3394, -2.3718, 1.0583),
    vec4(-3.1398, 5.4405, -0.3845, -9.1923), vec4(6.4303, -6.1500, 19.0148, 4.0550),
    vec4(-20.9648, 25.3985, -8.1321, -52.2766), vec4(25.8097, -42.7781, 85.2138, 4.4716));
const vec4 kWaveSteep[6] = vec4[6](
    vec4(0.022, 0.027, 0.033, 0.038), vec4(0.042, 0.045, 0.045, 0.042),
    vec4(0.040), vec4(0.040), vec4(0.040), vec4(0.040));
const int kMovers = 2;                     // groups that move the surface, of four waves each

struct Hit { float t; int id; vec3 nor; };
const Hit kNothing = Hit(0.0, kSky, vec3(0.0, 1.0, 0.0));
// spread: lost slope variance xx, zz, xz; tails: how much longer than a Gaussian's its tails are.
struct Sea { float height; vec2 slope; vec3 spread; float tails; };
struct Eye { vec3 pos, right, up, forward; float lens; };

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

// Reflected share of unpolarised light, exact; eta: index beyond over index before the surface.
float fresnel(float cosI, float eta) {
    float gg = (eta - 1.0) * (eta + 1.0) + cosI * cosI;
    if (gg <= 0.0) return 1.0;
    float g = sqrt(gg);
    float a = (g - cosI) / max(g + cosI, 1e-9);
    float b = (cosI * (g + cosI) - 1.0) / (cosI * (g - cosI) + 1.0);
    return min(0.5 * a * a * (1.0 + b * b), 1.0);
}

vec3 safeInverse(vec3 rd) {   // never infinite, so a slab never multiplies 0 by infinity
    return 1.0 / mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
}

vec3 sunDirection() {
    float a = radians(sunAngle), h = radians(sunHeight);
    return vec3(sin(a) * cos(h), sin(h), -cos(a) * cos(h));
}

// ---- The sea ------------------------------------------------------------------------------------
// A height field: a sum of cosines, each a little sharpened by its second harmonic, h(p) = sum a
// (cos x + B cos 2x) with x = k.p - w t and w^2 = g |k|, as in deep water (Airy, 1845). A pixel
// near the horizon covers many waves. Of those it sees the mean slope, which it mirrors by, and how
// much slopes differ, the spread: a Gaussian of slopes turns the sun's image into a lobe whose
// height is the share of slopes that send sunlight here (Cox and Munk). So a wave never vanishes:
// what leaves the surface as shape comes back as roughness, and nothing flickers.

// Wave vectors of a group in the world's frame.
void waveVectors(int g, out vec4 x, out vec4 z) {
    float c = cos(radians(windAngle)), s = sin(radians(windAngle));
    x = c * kWaveX[g] + s * kWaveZ[g];
    z = c * kWaveZ[g] - s * kWaveX[g];
}
vec4 waveTurns(vec4 k, uint tick) {   // cycles since the start, deep-water dispersion
    uvec4 hz = uvec4(sqrt(kGravity * k) * (animation * 65536.0 / (2.0 * kPi)));
    return vec4(hz * tick) / 4294967296.0;
}
float crest() { return 0.25 * choppiness; }   // second harmonic; over 1/4 a wave has two crests

// Adds four waves, averaged over a Gaussian footprint with covariance blur (xx, zz, xz; m^2): a
// cosine keeps exp(-(k sigma)^2 / 2) of its height, and what its slope loses goes to the spread,
// and to the tails a cosine's fourth cumulant, -3/2 of its variance squared. varied: mean square of
// the gain over the square of its mean.
void addWaves(int g, vec2 p, vec3 blur, float gain, float varied, inout Sea s) {
    vec4 x, z;
    waveVectors(g, x, z);
    vec4 k = sqrt(x * x + z * z), a = gain * kWaveSteep[g] / k;
    vec4 phase = x * p.x + z * p.y - 2.0 * kPi * waveTurns(k, iTick);
    vec4 keep = exp(-0.5 * (x * x * blur.x + z * z * blur.y + 2.0 * x * z * blur.z));
    vec4 keep2 = keep * keep, harmonic = crest() * keep2 * keep2;
    vec4 c = cos(phase), n = sin(phase), down = a * n * (keep + 4.0 * harmonic * c);
    vec4 lost = 0.5 * a * a * (varied * (1.0 + 4.0 * crest() * crest())
                               - keep2 - 4.0 * harmonic * harmonic);
    s.height += dot(a, keep * c + harmonic * (2.0 * c * c - 1.0));
    s.slope -= vec2(dot(down, x), dot(down, z));
    s.spread += vec3(dot(lost, x * x), dot(lost, z * z), dot(lost, x * z));
    vec4 variance = lost * k * k;
    s.tails -= 1.5 * dot(variance, variance);
}
// Ripples come in patches, where gusts touch the water. y: the variance that the footprint hides.
vec2 gust(vec2 p, vec3 blur) {
    vec2 a = turn(p, radians(windAngle));
    float keep = exp(-0.03 * (blur.x + blur.y));
    float u = sin(0.21 * a.x + 0.9 * sin(0.13 * a.y) - 2.0 * kPi * cycles(0.14));
    float v = sin(0.11 * a.x - 0.17 * a.y - 2.0 * kPi * cycles(0.11));
    return vec2(1.0 + 0.45 * keep * u * v, square(0.225) * (1.0 - keep * keep));
}
Sea sea(vec2 p, vec3 blur) {
    Sea s = Sea(0.0, vec2(0.0), vec3(kCalmSpread, kCalmSpread, 0.0), 0.0);
    for (int g = 0; g < kMovers; ++g) addWaves(g, p, blur, waveHeight, 1.0, s);
    vec2 gain = gust(p, blur);
    float varied = 1.0 + gain.y / (gain.x * gain.x), calm = s.spread.x + s.spread.y;
    for (int g = kMovers; g < 6; ++g) addWaves(g, p, blur, ripples * gain.x, varied, s);
    float both = s.spread.x + s.spread.y;
    // Slopes under gusts are Gaussians of many widths: together they have long tails.
    s.tails = (s.tails + 8.0 * (varied - 1.0) * square(both - calm)) / (16.0 * square(both));
    return s;
}
// Covariance of the footprint on the sea of a pixel of width w that is seen along rd.
vec3 seaFootprint(vec3 rd, float w) {
    float across = square(0.35 * w), along = across / max(square(rd.y), 1e-6) - across;
    vec2 v = rd.xz * inversesqrt(max(dot(rd.xz, rd.xz), 1e-12));
    return vec3(across + along * v * v, along * v.x * v.y);
}

// Long waves along a ray: a height is dot(a, cosine(start + rate t)), harmonic included. A wave
// that is lower than half a pixel no longer moves the surface.
struct Movers { vec4 a, start, rate; };
Movers moversAlong(int g, vec3 ro, vec3 rd, float w) {
    vec4 x, z;
    waveVectors(g, x, z);
    vec4 k = sqrt(x * x + z * z), a = waveHeight * kWaveSteep[g] / k;
    return Movers(a * clamp(4.0 * a / max(w, 1e-6) - 1.0, 0.0, 1.0),
                  x * ro.x + z * ro.z - 2.0 * kPi * waveTurns(k, iTick), x * rd.x + z * rd.z);
}
int seaEvaluations = 0;   // of a ray's height over the sea, for measurements
float moversHeight(Movers m, float t) {
    vec4 c = cos(m.start + m.rate * t);
    return dot(m.a, c + crest() * (2.0 * c * c - 1.0));
}
// Steepest descent of cos x + B cos 2x, B = crest() <= 1/4: of sin x (1 + b cos x) with b = 4 B, it
// is where cos x = c solves 2 b c^2 + c = b.
float steepestShape() {
    float b = 4.0 * crest(), c = 2.0 * b / (sqrt(1.0 + 8.0 * b * b) + 1.0);
    return sqrt(1.0 - c * c) * (1.0 + b * c);
}
// Where a ray from above meets the sea, or -1. pixel: angle of a pixel, rad. The four longest waves
// have a known slope here and a bounded curvature; the next four are as steep or as high as they
// can be. With a gap f that closes at the speed c and bends by at most b, nothing is met before
// 2 f / (c + sqrt(c^2 + 2 b f)); all waves are rarely at their worst at once, and a fifth more is
// stepped. None is shorter than `least`, which may cut crests that are lower than a millimetre. The
// last few go where a line through both ends is 0; the end that stays halves its gap (Illinois).
float hitSea(vec3 ro, vec3 rd, float pixel, float tMax) {
    seaEvaluations = 0;
    float reach = pixel * max(ro.y, 0.0) / max(-rd.y, 1e-4);
    Movers m0 = moversAlong(0, ro, rd, reach), m1 = moversAlong(1, ro, rd, reach);
    float top1 = (1.0 + crest()) * dot(m1.a, vec4(1.0));
    float top = (1.0 + crest()) * dot(m0.a, vec4(1.0)) + top1 + 1e-4;
    float steep1 = steepestShape() * dot(m1.a, abs(m1.rate));
    float bend0 = 2.0 * (1.0 + 4.0 * crest()) * dot(m0.a, m0.rate * m0.rate);
    float slope = abs(rd.y) < 1e-7 ? -1e-7 : rd.y;
    float enter = max((top - ro.y) / slope, 0.0) * step(top, ro.y);
    float leave = min(((slope < 0.0 ? -top : top) - ro.y) / slope, tMax);
    float t = enter, least = min(0.004 + 0.004 * enter, 0.06) + 0.5 * pixel * enter;   // m
    vec2 above = vec2(t, 0.0), below = vec2(-1.0, 0.0);
    bool ahead = enter < leave && (slope < 0.0 || ro.y < top);
    for (int k = 0; k < seaSteps && ahead; ++k) {
        vec4 phase = m0.start + m0.rate * t, c = cos(phase), n = sin(phase);
        float f0 = ro.y + t * rd.y - dot(m0.a, c + crest() * (2.0 * c * c - 1.0));
        float close0 = -rd.y - dot(m0.a * m0.rate, n * (1.0 + 4.0 * crest() * c));
        float f = f0 - moversHeight(m1, t), close = close0 + steep1, over = max(f0 - top1, 0.0);
        ++seaEvaluations;
        if (f <= 0.0) below = vec2(t, f);
        else above = vec2(t, f);
        ahead = f > 0.0 && t < leave;
        f = max(f, 0.0);
        float far = 2.4 * f / max(close + sqrt(close * close + bend0 * f), 1e-6);
        float far0 = 2.4 * over / max(close0 + sqrt(close0 * close0 + bend0 * over), 1e-6);
        float even = (leave - enter) / float(seaSteps);
        t = min(t + (march == 0 ? max(max(far, far0), least) : even), leave);
    }
    if (below.x < 0.0) return ahead ? above.x : -1.0;   // out of steps: nearly there
    for (int k = loopStart(); k < 4; ++k) {
        t = mix(above.x, below.x, clamp(above.y / max(above.y - below.y, 1e-20), 0.02, 0.98));
        float f = ro.y + t * rd.y - moversHeight(m0, t) - moversHeight(m1, t);
        if (f > 0.0) {
            above = vec2(t, f);
            below.y *= 0.5;
        } else {
            below = vec2(t, f);
            above.y *= 0.5;
        }
    }
    return t;
}

// Mean of max(0, X) for X normal with mean m and deviation s: the area that a rough surface shows.
float shownArea(float m, float s) {
    float q = m / max(s, 1e-6);
    if (q > 4.0) return m;
    float density = 0.39894228 * exp(-0.5 * min(q * q, 80.0));
    float tail = 1.0 / (1.0 + 0.2316419 * abs(q));
    float above = 1.0 - density * tail * (0.31938153 + tail * (-0.356563782 + tail * (1.781477937
        + tail * (-1.821255978 + tail * 1.330274429))));   // Abramowitz and Stegun 26.2.17
    return max(m * (q < 0.0 ? 1.0 - above : above) + s * density, 1e-5);
}
// What a view along rd sees of slopes with a mean and a spread: the area shown, and the mean slope
// of what is shown, which leans towards the eye.
float shownSlope(vec3 rd, Sea s, out vec2 slope) {
    vec2 lean = vec2(s.spread.x * rd.x + s.spread.z * rd.z, s.spread.z * rd.x + s.spread.y * rd.z);
    float deviation = sqrt(max(dot(lean, rd.xz), 0.0)), m = dot(s.slope, rd.xz) - rd.y;
    float area = shownArea(m, deviation);
    float ahead = 1.0 / (1.0 + exp(clamp(-1.702 * m / max(deviation, 1e-6), -30.0, 30.0)));
    slope = s.slope + lean * (ahead / area);
    return area;
}
// The sun in a sea of nearly Gaussian slopes, for one unit of its light (Bruneton et al. 2010, eq.
// 7, with the shown area in closed form, and the first term of an Edgeworth series for the tails).
float seaGlitter(vec3 rd, Sea s, float area) {
    vec3 h = normalize(sunDirection() - rd + vec3(0.0, 1e-5, 0.0));
    if (h.y < 0.05) return 0.0;
    float sunSpread = square(0.25 * radians(sunSize));
    vec3 v = s.spread + vec3(sunSpread, sunSpread, 0.0);
    vec2 d = -h.xz / h.y - s.slope;
    float det = max(v.x * v.y - v.z * v.z, 1e-12);
    float q = (d.x * d.x * v.y + d.y * d.y * v.x - 2.0 * d.x * d.y * v.z) / det;
    float density = exp(-0.5 * min(q, 80.0)) / (2.0 * kPi * sqrt(det));
    float tails = s.tails * square((s.spread.x + s.spread.y) / (v.x + v.y));
    density *= max(1.0 + tails * (q * q - 8.0 * q + 8.0), 0.0);
    return fresnel(clamp(-dot(h, rd), 0.0, 1.0), kIorWater) * density
        / (4.0 * square(square(h.y)) * area);
}

// ---- Things -------------------------------------------------------------------------------------
// Rabbits, ring and frame are fields whose value is never more than the distance to the surface: a
// ray may step on by it and cannot pass through (sphere tracing, Hart). For an ellipsoid with least
// radius low, (|p / r| - 1) low is such a bound; a smooth union lowers it further, where two meet.

// Fields carry their gradient: vec4(gradient, value). A value is never more than the distance.
vec4 ellipsoid(vec3 p, vec3 r) {
    vec3 u = p / r;
    float l = max(length(u), 1e-6), low = min(r.x, min(r.y, r.z));
    return vec4(u / r * (low / l), (l - 1.0) * low);
}
vec4 join(vec4 a, vec4 b, float k) {   // smooth union; a mean of gradients, so no steeper than both
    float h = clamp(0.5 + 0.5 * (b.w - a.w) / k, 0.0, 1.0);
    return mix(b, a, h) - vec4(0.0, 0.0, 0.0, k * h * (1.0 - h));
}
// Ear's own frame: leans out and back.
vec3 toEar(vec3 p) {
    vec3 q = p - vec3(0.05, 0.53, 0.045);
    q.xy = turn(q.xy, -0.22);
    q.zy = turn(q.zy, 0.20);
    return q - vec3(0.0, 0.15, 0.0);
}
vec4 rabbitField(vec3 q) {
    float side = q.x < 0.0 ? -1.0 : 1.0;
    vec3 p = vec3(abs(q.x), q.yz);
    vec4 f = ellipsoid(p - vec3(0.0, 0.17, -0.03), vec3(0.185, 0.20, 0.20));
    f = join(f, ellipsoid(p - vec3(0.10, 0.09, 0.03), vec3(0.095, 0.12, 0.13)), 0.06);
    f = join(f, ellipsoid(p - vec3(0.0, 0.28, 0.05), vec3(0.125, 0.14, 0.115)), 0.08);
    f = join(f, ellipsoid(p - vec3(0.10, -0.01, 0.16), vec3(0.05, 0.04, 0.10)), 0.03);
    f = join(f, ellipsoid(p - vec3(0.0, 0.09, -0.23), vec3(0.07, 0.07, 0.065)), 0.03);
    f = join(f, ellipsoid(p - vec3(0.075, 0.185, 0.20), vec3(0.04, 0.042, 0.085)), 0.05);
    f = join(f, ellipsoid(p - vec3(0.0, 0.465, 0.08), vec3(0.13, 0.115, 0.128)), 0.05);
    f = join(f, ellipsoid(p - vec3(0.052, 0.425, 0.155), vec3(0.062, 0.05, 0.058)), 0.04);
    f = join(f, ellipsoid(p - vec3(0.0, 0.437, 0.20), vec3(0.042, 0.034, 0.034)), 0.03);
    vec3 q2 = toEar(p);
    float far = max(length(q2), 1e-6);
    vec4 ear = ellipsoid(q2, vec3(0.045, 0.165, 0.026));
    if (far - 0.165 > ear.w) ear = vec4(q2 / far, far - 0.165);   // far off its ball is nearer
    ear.zy = turn(ear.zy, -0.20);
    ear.xy = turn(ear.xy, 0.22);
    f = join(f, ear, 0.03);
    vec4 eye = ellipsoid(p - vec3(0.098, 0.485, 0.158), vec3(0.028));
    if (eye.w < f.w) f = eye;
    f.x *= side;
    return f;
}
vec4 ringField(vec3 p) {
    float around = max(length(p.xz), 1e-6);
    vec2 d = vec2(around - 0.305, p.y - 0.05);
    float l = max(length(d), 1e-6);
    return vec4(p.x / around * d.x / l, d.y / l, p.z / around * d.x / l, l - 0.10);
}
vec3 archField(vec2 p) {   // a doorway without a floor: gradient and distance
    vec2 d = vec2(p.x, max(p.y - kSpring, 0.0));
    float l = max(length(d), 1e-6);
    return vec3(d / l, l - kArch);
}
vec4 frameField(vec3 p) {   // a tube round the doorway's edge
    vec3 a = archField(p.xy);
    float l = max(length(vec2(a.z, p.z)), 1e-6);
    return vec4(a.xy * a.z / l, p.z / l, l - kTube);
}

// The frames of the clusters: rabbit with lifebuoy, rabbit that swims, mirror.
struct Frame { vec3 at; mat3 axes; };   // columns right, up, forward
Frame frames[3];
void readFrames() {
    for (int c = 0; c < 3; ++c) {
        vec4 at = texelFetch(poses, ivec2(2 * c, 0), 0);
        vec4 tilt = texelFetch(poses, ivec2(2 * c + 1, 0), 0);
        vec3 up = normalize(vec3(-tilt.x, 1.0, -tilt.y));
        vec3 right = normalize(cross(up, vec3(sin(at.w), 0.0, cos(at.w))));
        frames[c] = Frame(at.xyz, mat3(right, up, cross(right, up)));
    }
}
vec4 clusterField(int c, vec3 p, out int id) {
    id = kGilt;
    if (c == 2) return frameField(p);
    id = kFur;
    vec4 f = rabbitField(p);
    if (c == 0) {
        vec4 ring = ringField(p);
        if (ring.w < f.w) {
            f = ring;
            id = kRing;
        }
    }
    return f;
}
// Where a ray may meet a cluster; nothing when y < x.
vec2 clusterSpan(int c, vec3 ro, vec3 rd, float grow) {
    if (c == 2) {
        vec3 inv = safeInverse(rd), lo = vec3(-kArch, -2.0, 0.0);
        vec3 hi = vec3(kArch, kSpring + kArch, 0.0);
        vec3 a = (lo - kTube - grow - ro) * inv, b = (hi + kTube + grow - ro) * inv;
        vec3 n = min(a, b), f = max(a, b);
        return vec2(max(max(n.x, n.y), max(n.z, 0.0)), min(f.x, min(f.y, f.z)));
    }
    vec3 f = ro - vec3(0.0, 0.37, 0.0);
    float b = dot(f, rd), d = square(0.54 + grow) - dot(f - b * rd, f - b * rd);
    if (d < 0.0) return vec2(1.0, -1.0);
    return vec2(max(-b - sqrt(d), 0.0), -b + sqrt(d));
}
bool clusterThere(int c) { return c == 2 ? mirror : rabbits > c; }

// Rays in the frames of the clusters, and where they may meet them. All clusters share one loop:
// where nothing branches, a loop that is not needed still costs one turn.
struct Walk { vec3 o[3], d[3]; vec2 span[3]; };
Walk walkClusters(vec3 ro, vec3 rd, float grow, float tMax) {
    Walk w;
    for (int c = 0; c < 3; ++c) {
        w.o[c] = (ro - frames[c].at) * frames[c].axes;
        w.d[c] = rd * frames[c].axes;
        vec2 span = clusterSpan(c, w.o[c], w.d[c], grow);
        w.span[c] = vec2(span.x, clusterThere(c) ? min(span.y, tMax) : -1.0);
    }
    return w;
}
bool onward(Walk w, inout int c, inout float t, out float end) {   // to the next cluster
    c = c < 0 && w.span[0].x < w.span[0].y ? 0 : c < 1 && w.span[1].x < w.span[1].y ? 1
        : c < 2 && w.span[2].x < w.span[2].y ? 2 : 3;
    vec2 span = c == 0 ? w.span[0] : c == 1 ? w.span[1] : w.span[2];
    t = span.x;
    end = span.y;
    return c < 3;
}

// How deep a thing is along a ray from a point of its surface.
float depthOfThing(int id, vec3 ro, vec3 rd) {
    bool first = id == kRing || distance(ro, frames[0].at) < distance(ro, frames[1].at);
    int c = id < kRing ? 2 : first ? 0 : 1;
    Walk w = walkClusters(ro, rd, 0.0, kFar);
    vec3 o = c == 0 ? w.o[0] : c == 1 ? w.o[1] : w.o[2];
    vec3 d = c == 0 ? w.d[0] : c == 1 ? w.d[1] : w.d[2];
    float t = 0.004;
    bool inside = id > kGlass;
    for (int k = 0; k < 24 && inside; ++k) {
        float f = clusterField(c, o + t * d, id).w;
        inside = f < 0.0;
        t += max(-f, 0.004);
    }
    return id > kGlass ? t : 0.1;
}

// The nearest thing on a ray before tMax.
Hit hitThings(vec3 ro, vec3 rd, float pixel, float tMax) {
    Walk w = walkClusters(ro, rd, 0.0, tMax);
    float glass = -w.o[2].z / (abs(w.d[2].z) < 1e-6 ? 1e-6 : w.d[2].z);
    bool pane = mirror && glass > 0.0 && glass < tMax
        && archField((w.o[2] + glass * w.d[2]).xy).z < 0.0;
    bool front = w.d[2].z < 0.0;
    float best = pane ? glass : tMax, t = 0.0, end = 0.0;
    int c = -1, hit = -1;
    vec3 at = vec3(0.0);
    bool more = onward(w, c, t, end);
    for (int k = 0; k < kTraceSteps && more; ++k) {
        vec3 p = c == 0 ? w.o[0] + t * w.d[0] : c == 1 ? w.o[1] + t * w.d[1] : w.o[2] + t * w.d[2];
        int id;
        float f = clusterField(c, p, id).w;
        bool met = f < 1e-4 + 0.1 * pixel * t && t < best;
        if (met) {
            best = t;
            hit = c;
            at = p;
        }
        t += f;
        if (met || t >= min(end, best)) more = onward(w, c, t, end);
    }
    Hit h = Hit(best, kSky, vec3(0.0, 1.0, 0.0));
    if (pane) h = Hit(best, front ? kGlass : kBack, front ? frames[2].axes[2] : -frames[2].axes[2]);
    int id;
    vec3 g = clusterField(hit, at, id).xyz;
    g *= inversesqrt(max(dot(g, g), 1e-12));
    if (hit >= 0) {
        h.id = id;
        h.nor = hit == 0 ? frames[0].axes * g : hit == 1 ? frames[1].axes * g : frames[2].axes * g;
    }
    return h;
}

// A look round from a point on a thing, to tell how open its surroundings are: how far the nearer
// rabbit's cluster is from a point along the normal.
struct Look { bool due; int c; vec3 at; float far; };
Look lookFrom(vec3 p, vec3 nor) {
    bool first = distance(p, frames[0].at) < distance(p, frames[1].at);
    vec3 q = p + 0.13 * nor;
    return Look(true, first ? 0 : 1, first ? (q - frames[0].at) * frames[0].axes
                                           : (q - frames[1].at) * frames[1].axes, 0.0);
}
float openness(Look look) { return 0.35 + 0.65 * smoothstep(0.0, 0.8, look.far / 0.13); }

// Share of the sun that a point sees; rim: slope of the sun's disc. The narrowest gap between the
// ray and a thing, against the cone's width there, tells how much of the disc is hidden. A look that
// is due is the first turn of the same loop: a driver compiles a copy of the field for each place
// that calls it.
float sunShare(vec3 ro, vec3 rd, float rim, inout Look look) {
    Walk w = walkClusters(ro, rd, 0.03, kFar);
    float t = -w.o[2].z / (abs(w.d[2].z) < 1e-6 ? 1e-6 : w.d[2].z);
    float end = 0.0, gap = 1.0, pane = 1.0;
    if (mirror && t > 0.0)
        pane = clamp((archField((w.o[2] + t * w.d[2]).xy).z - kTube) / (rim * t + 1e-4), -1.0, 1.0);
    w.span[2].y = -1.0;
    int c = -1;
    bool more = onward(w, c, t, end);
    for (int k = look.due ? -1 : 0; k < 64 && (k < 0 || more); ++k) {
        int id;
        t = max(t, 0.01);
        vec3 q = c == 0 ? w.o[0] + t * w.d[0] : w.o[1] + t * w.d[1];
        vec4 f = clusterField(k < 0 ? look.c : c, k < 0 ? look.at : q, id);
        if (k < 0) {
            look.far = f.w;
            look.due = false;
        } else {
            gap = min(gap, f.w * inversesqrt(max(dot(f.xyz, f.xyz), 1e-4)) / (rim * t + 1e-4));
            t += max(f.w, 0.004 + 0.3 * rim * t);
            if (t >= end) more = onward(w, c, t, end);
            more = more && gap > -1.0;
        }
    }
    gap = max(gap, -1.0);
    return 0.0625 * square(1.0 + gap) * (2.0 - gap) * square(1.0 + pane) * (2.0 - pane);
}
float sunlight(vec3 p, vec3 nor, float seed, inout Look look) {
    vec3 rd = sunDirection();
    float rim = tan(radians(sunSize));
    if (shadows == 0) {
        int id;
        look.far = clusterField(look.c, look.at, id).w;
        return 1.0;
    }
    if (shadows == 1) return sunShare(p + 0.004 * nor, rd, rim, look);
    vec3 u = normalize(cross(rd, vec3(0.0, 0.0, 1.0) + 0.01 * rd.zxy)), v = cross(u, rd);
    float sum = 0.0;
    for (int k = 0; k < sunSamples; ++k) {
        float a = 2.0 * kPi * (kGolden * float(k) + seed);
        float r = rim * sqrt((float(k) + 0.5) / float(sunSamples));
        vec3 towards = normalize(rd + r * (u * cos(a) + v * sin(a)));
        sum += sunShare(p + 0.004 * nor, towards, 1e-4, look);
    }
    return sum / float(sunSamples);
}

const float kSunk = 0.31;                  // m, of the rabbit that swims
// How wet a float is at a point: a band that the water has just left, ragged at its upper edge.
float waterline(vec3 p, bool first, vec3 q) {
    float above = p.y - (first ? frames[0].at.y : frames[1].at.y + kSunk);
    above += 0.008 * sin(41.0 * q.x + 2.0 * sin(33.0 * q.z)) + 0.004 * sin(90.0 * q.z);
    return smoothstep(-0.05, -0.01, above) * (1.0 - smoothstep(0.018, 0.034, above));
}
// What a thing is made of: colour, and in w how much of the light behind it comes through.
vec4 paint(int id, vec3 p, float w) {
    if (id == kGilt) return vec4(0.95, 0.62, 0.22, 0.0);
    if (id == kBack) return vec4(0.10, 0.055, 0.03, 0.0);
    bool first = id == kRing || distance(p, frames[0].at) < distance(p, frames[1].at);
    vec3 q = first ? (p - frames[0].at) * frames[0].axes : (p - frames[1].at) * frames[1].axes;
    if (id == kRing) {   // white, with four red quarters
        float a = atan(q.z, q.x + (q.x == 0.0 ? 1e-9 : 0.0)) * (2.0 / kPi) + 0.5;
        float edge = (abs(fract(a) - 0.5) - 0.27) * 0.48;
        float red = smoothstep(-0.5 * w - 0.002, 0.5 * w + 0.002, -edge);
        vec3 tint = mix(vec3(0.82, 0.80, 0.76), vec3(0.66, 0.035, 0.025), red);
        return vec4(tint * (1.0 - 0.35 * waterline(p, first, q)), 0.0);
    }
    vec3 tint = linearColour(furColour) * (1.0 - 0.55 * waterline(p, first, q));
    q.x = abs(q.x);
    vec3 ear = toEar(q);
    vec3 pink = vec3(0.85, 0.36, 0.30);
    float inside = smoothstep(0.0, 0.012, ear.z)
        * (1.0 - smoothstep(0.7, 1.0, length(ear.xy / vec2(0.034, 0.14))));
    vec3 tip = (q - vec3(0.0, 0.457, 0.228)) * vec3(0.8, 1.25, 1.0);
    float nose = 1.0 - smoothstep(0.016, 0.024, length(tip));
    float blush = 0.35 - 0.35 * smoothstep(0.0, 0.05, length(q - vec3(0.09, 0.43, 0.19)));
    tint = mix(tint, pink, max(0.75 * inside, max(nose, blush)));
    float belly = 1.0 - smoothstep(0.0, 0.16, length(q - vec3(0.0, 0.27, 0.16)));
    tint = mix(tint, vec3(0.95, 0.92, 0.88), 0.6 * belly);
    float eye = 1.0 - smoothstep(0.0285, 0.0305, length(q - vec3(0.098, 0.485, 0.158)));
    vec3 glint = q - vec3(0.098, 0.485, 0.158) - 0.028 * vec3(0.46, 0.51, 0.73);
    float catchLight = 1.0 - smoothstep(0.0075, 0.0095, length(glint));
    float through = 0.9 * smoothstep(-0.17, -0.07, ear.y) * (1.0 - eye);
    vec3 pupil = mix(vec3(0.012, 0.008, 0.008), vec3(1.6, 1.5, 1.4), catchLight);
    return vec4(mix(tint, pupil, eye), eye > 0.5 ? -1.0 : through);
}

// ---- The sky ------------------------------------------------------------------------------------
// Sunlight scattered once on its way through air that thins with height: at each point of the view
// ray, what the sun sends through the air above, times the share that turns towards the eye, times
// what is left behind that point: sum T_view(t) (beta_R P_R + beta_M P_M) T_sun(t) dt. It is worked
// out once per look, into a buffer over half the dome, since the sky is the same on both its sides.

// Density of air (Rayleigh, Mie, ozone) at a height, relative to the sea's level.
vec3 airDensity(float y) {
    return vec3(exp(-y / 8e3), exp(-y / 1.2e3), max(0.0, 1.0 - abs(y - 25e3) / 15e3));
}
// Height along a ray from height y0 with sine of elevation s; a parabola stands for the sphere.
float airHeight(float y0, float s, float t) {
    return y0 + t * (s + t * (1.0 - s * s) / (2.0 * kEarth));
}
float airLength(float y0, float s) {   // to the top of the air
    float a = (1.0 - s * s) / (2.0 * kEarth), c = y0 - kAir;
    return -2.0 * c / max(s + sqrt(max(s * s - 4.0 * a * c, 0.0)), 1e-6);
}
vec3 airExtinction(vec3 density) {
    return kRayleigh * density.x + vec3(1.1 * kMie * haze * density.y) + kOzone * density.z;
}
vec3 airTransmittance(float y0, float s, int steps) {
    float far = airLength(y0, s);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < steps; ++k) {   // finer near the start, where air is dense
        float a = square(float(k) / float(steps)), b = square(float(k + 1) / float(steps));
        sum += airExtinction(airDensity(max(airHeight(y0, s, 0.5 * (a + b) * far), 0.0))) * (b - a);
    }
    return exp(-sum * far);
}
vec3 sunBeam() { return texelFetch(ambient, ivec2(6, 0), 0).rgb; }

// The clear sky, from its buffer: sine of half the angle from the sun's azimuth, root of height.
vec3 clearSky(vec3 rd) {
    vec2 level = normalize(rd.xz + vec2(0.0, 1e-9));
    vec2 sun = normalize(sunDirection().xz + vec2(0.0, 1e-9));
    vec2 uv = vec2(sqrt(max(0.5 - 0.5 * dot(level, sun), 0.0)), sqrt(clamp(rd.y, 0.0, 1.0)));
    return textureLod(sky, (0.5 + uv * vec2(255.0, 127.0)) / vec2(256.0, 128.0), 0.0).rgb;
}
float cloudNoise(vec2 p, int period, int seed) {
    vec2 c = floor(p), f = p - c, s = f * f * (3.0 - 2.0 * f);
    ivec2 a = ivec2(c) & (period - 1), b = (a + 1) & (period - 1);
    return mix(mix(random3(ivec3(a, seed)).x, random3(ivec3(b.x, a.y, seed)).x, s.x),
               mix(random3(ivec3(a.x, b.y, seed)).x, random3(ivec3(b, seed)).x, s.x), s.y);
}
// Thickness of the clouds overhead; width: angle that is averaged, rad.
float cloudCover(vec3 rd, float width) {
    float y = max(rd.y, 0.01) + 0.04, w = 1.6 * width / (y * sqrt(y));   // both axes' mean
    vec2 p = rd.xz / y * vec2(1.1, 2.2) + vec2(512.0 * cycles(0.000153), 64.0);
    float sum = 0.0, gain = 0.5;
    for (int k = loopStart(); k < 5; ++k) {
        float keep = clamp(1.3 - w * exp2(float(k)), 0.0, 1.0);
        if (keep <= 0.0) {   // the rest averages to half
            sum += gain;
            break;
        }
        sum += gain * mix(0.5, cloudNoise(p * exp2(float(k)) + 512.0, 512 << k, 40 + k), keep);
        gain *= 0.5;
    }
    float soft = 0.22 + min(0.5 * w, 0.3);
    float cover = smoothstep(1.0 - clouds - soft, 1.0 - clouds + soft, sum * 0.96);
    return cover * smoothstep(0.0, 0.12, rd.y);
}
// What comes from above the horizon along rd. width: angle that is averaged; disc: with the sun.
vec3 airLight(vec3 rd, float width, bool disc) {
    vec3 sum = clearSky(rd), sun = sunDirection();
    float cosine = dot(rd, sun), away2 = max(2.0 - 2.0 * cosine, 0.0);
    if (clouds > 0.0 && rd.y > 0.0) {
        float cover = cloudCover(rd, width);
        // Thin edges pass sunlight on, the more the nearer to it; thick middles shade themselves.
        float silver = 0.07 + 0.30 / (1.0 + 14.0 * away2);
        vec3 lit = sunBeam() * silver * 1.1 + texelFetch(ambient, ivec2(2, 0), 0).rgb * 0.2;
        sum = mix(sum, mix(sum, lit, 0.8), cover * (1.0 - 0.25 * cover));
        sum *= mix(vec3(1.0), vec3(0.76, 0.72, 0.75), cover * cover);
    }
    if (disc) {
        float sun2 = square(radians(sunSize)), r2 = sun2 + 0.5 * square(width);
        float edge = max(width, 1e-4) * 0.5 * sqrt(r2);
        float seen = sun2 / r2 * (1.0 - smoothstep(r2 - edge, r2 + edge, away2));
        seen *= smoothstep(-0.002, 0.002, rd.y);
        sum += sunBeam() * (seen * 30.0 + 0.0003 / (away2 + 0.0008)) + 12.0 * seen;
    }
    return sum;
}

vec3 ambientLight(vec3 nor) {   // from all around, on a surface that faces nor
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        int face = 2 * k + (nor[k] > 0.0 ? 1 : 0);
        sum += texelFetch(ambient, ivec2(face, 0), 0).rgb * square(nor[k]);
    }
    return sum;
}

// Light from a point of a thing against d; upWeight: of what its gloss mirrors. stuff: paint.
vec3 thingLight(int id, vec3 p, vec3 nor, vec3 d, vec4 stuff, float share, float open,
                out vec3 upWeight) {
    float facingSun = dot(nor, sunDirection()), facingEye = clamp(-dot(nor, d), 0.0, 1.0);
    vec3 sunny = sunBeam() * share, around = ambientLight(nor) * open;
    float lit = max(facingSun, 0.0), grazing = square(square(1.0 - facingEye)) * (1.0 - facingEye);
    upWeight = vec3(id == kRing || stuff.w < 0.0 ? fresnel(facingEye, 1.45) : 0.0);
    if (id == kGilt) {
        upWeight = mix(stuff.rgb, vec3(1.0), grazing);
        stuff.rgb *= 0.1;
    }
    float mirrorLine = max(dot(reflect(d, nor), sunDirection()), 0.0);
    vec3 light = upWeight * sunny * (lit * 8.0 * exp2(130.0 * (mirrorLine - 1.0)));
    if (id == kFur && stuff.w >= 0.0) {
        lit = square(max((facingSun + 0.4) / 1.4, 0.0));   // hair lets light round the edge
        float fuzz = (1.0 - facingEye) * square(1.0 - facingEye);
        light += stuff.rgb * fuzz
            * (0.3 * sunny * max(dot(sunDirection(), d), 0.0) + 0.2 * around);
        light += vec3(1.0, 0.50, 0.34) * sunny * (0.13 * stuff.w * max(-facingSun, 0.0));
    }
    return light + stuff.rgb / kPi * (lit * sunny + around);
}
// Dry hairs at the outline of fur, before the sun: they glow. share: of the sun.
vec3 rimLight(int id, vec3 nor, vec3 d, vec4 stuff, float share) {
    if (id != kFur || stuff.w < 0.0) return vec3(0.0);
    float outline = square(1.0 - clamp(-dot(nor, d), 0.0, 1.0));
    return stuff.rgb * sunBeam() * (kRim * share * outline * max(dot(sunDirection(), d), 0.0));
}
vec3 mirrorSky(vec3 d, float width, bool disc) {   // biased: below the horizon the sea, dimmer
    float dim = mix(0.45, 1.0, smoothstep(-0.15, 0.1, d.y));
    return dim * airLight(normalize(vec3(d.x, abs(d.y), d.z)), width, disc);
}
vec3 deepLight() {   // scattered back by deep water
    vec3 down = texelFetch(ambient, ivec2(3, 0), 0).rgb + sunBeam() * sin(radians(sunHeight));
    return linearColour(waterColour) * down * (0.8 / kPi);
}
float codeShare(float code) { return (fract(code) - 0.5) * 2.0; }

// ---- Screen-space rays --------------------------------------------------------------------------
// The picture knows the depth at each of its pixels. A mirrored ray's image is a straight line, and
// 1 / depth is linear along it: so the line is walked pixel by pixel, and where the ray's depth
// first passes what the picture shows, it has met that (McGuire and Mara). Three things can go
// wrong: a step passes behind a thin thing (so each pixel tells how deep its thing is), a grazing
// view has metres of water in half a pixel (so depth is interpolated), and the picture does not
// show what the ray would meet (so such rays are called doubtful, and traced exactly).

Eye camera() {
    vec4 at = texelFetch(poses, ivec2(6, 0), 0), to = texelFetch(poses, ivec2(7, 0), 0);
    vec3 forward = normalize(to.xyz - at.xyz);
    vec3 right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    return Eye(at.xyz, right, cross(right, forward), forward, focalLength / 24.0);
}
vec3 viewRay(Eye e, vec2 pixel) {
    vec2 uv = (pixel - 0.5 * iResolution.xy) / iResolution.y;
    return normalize(uv.x * e.right + uv.y * e.up + e.lens * e.forward);
}
vec3 toView(Eye e, vec3 p) { return (p - e.pos) * mat3(e.right, e.up, e.forward); }
vec2 toPixel(Eye e, vec3 v) { return 0.5 * iResolution.xy + iResolution.y * e.lens * v.xy / v.z; }

// The parts of a ray on which something can be hit: what the clusters bound, and the sea's crests.
vec4 reachOfRay(vec3 ro, vec3 rd) {
    vec2 all = vec2(kFar, -1.0);
    for (int c = 0; c < 3; ++c) {
        vec2 span = clusterSpan(c, (ro - frames[c].at) * frames[c].axes, rd * frames[c].axes, 0.02);
        if (clusterThere(c) && span.x < span.y) all = vec2(min(all.x, span.x), max(all.y, span.y));
    }
    vec2 wet = (ro.y - vec2(0.4, -0.4) * waveHeight) / max(-rd.y, 1e-5);
    wet = clamp(wet * vec2(0.95, 1.05) + vec2(-0.05, 0.05), 0.0, 60.0);   // a calm one is wide, too
    return vec4(all, rd.y < 0.0 ? wet : vec2(kFar, -1.0));
}

// Normal and depth that a texel shows, at half the price of texelFetch; the depth between texels.
vec4 shownIn(vec2 pixel) {
    vec4 texel = textureLod(normalDepth, pixel / iResolution.xy, 0.0);
    return vec4(texel.xyz, 1.0 / max(texel.w, 1e-9));
}
float smoothAt(vec2 pixel) {
    return 1.0 / max(textureLod(smoothDepth, pixel / iResolution.xy, 0.0).w, 1e-9);
}
int walkFetches = 0;   // of the depth buffer, for measurements
// How far behind what a texel shows a point at a depth lies, beyond what the thing there is deep.
float behindThing(vec4 texel, float depth) {
    float deep = thickness > 0.0 ? thickness : max(length(texel.xyz), 0.03);
    return depth - texel.w - deep - bias;
}
// A ray's image: pixel and depth at a share s of it, in perspective.
struct Line { vec2 pa, pb; float ka, kb; };
vec3 onLine(Line l, float s) { return vec3(mix(l.pa, l.pb, s), 1.0 / mix(l.ka, l.kb, s)); }

// A ray's image, and where on it something may be met; all but `own` are shares of the line.
struct Course {
    Line l;
    vec3 own;                  // normal of the surface that the ray leaves, which it never meets
    vec2 gap;                  // between these there is nothing
    float inside;              // as far the line is in the picture
    float perPixel, perStep;
    float start;               // beyond the pixel it starts in
};
// Clips a ray to what can be hit, to the near plane, to the picture. False where nothing is left.
bool plotCourse(Eye e, vec3 ro, vec3 rd, out Course c) {
    vec3 a = toView(e, ro), d = toView(e, e.pos + rd);
    vec4 parts = reachOfRay(ro, rd);
    vec2 reach = vec2(min(parts.x, parts.z), max(parts.y, parts.w));
    if (a.z <= kNear) return false;
    if (a.z + reach.y * d.z < kNear) reach.y = (kNear - a.z) / d.z;   // towards the camera
    if (reach.x >= reach.y) return false;
    vec3 b = a + reach.y * d;
    c.own = texelFetch(normalDepth, ivec2(toPixel(e, a)), 0).xyz;
    c.own *= inversesqrt(max(dot(c.own, c.own), 1e-12));
    a += reach.x * d;
    c.l = Line(toPixel(e, a), toPixel(e, b), 1.0 / a.z, 1.0 / b.z);
    vec2 dp = c.l.pb - c.l.pa;
    vec2 room = mix(c.l.pa / max(-dp, 1e-4), (iResolution.xy - 0.01 - c.l.pa) / max(dp, 1e-4),
                    greaterThan(dp, vec2(0.0)));
    c.inside = clamp(min(room.x, room.y), 0.0, 1.0);
    c.gap = clamp((parts.yz - reach.x) / (reach.y - reach.x), 0.0, 1.0);   // shares of the ray
    c.gap = min(c.gap * b.z / mix(vec2(a.z), vec2(b.z), c.gap), c.inside);
    c.perPixel = 1.0 / max(max(abs(dp.x), abs(dp.y)), 1.0);
    float part = max(c.inside - max(c.gap.y - c.gap.x, 0.0), 0.01);   // what may be met
    c.perStep = reflections == 1 ? part / 32.0
        : max(min(stride * c.perPixel, max(part / 32.0, c.perPixel)), part * sqrt(stride) / 60.0);
    c.start = reach.x > 0.0 ? 0.0 : 0.7 * c.perPixel;
    return true;
}

// Steps along the line until the depth of one step's ends spans what a pixel shows. rough: the ends
// of the last step. doubtful: the ray was close before a thing, and there that ends, or the line, or
// what the ray comes from is shown between them.
// What faces as the ray's start does (cosine 0.999), or along the ray (0.7), is never met.
bool marchCourse(Course c, vec3 rd, inout vec2 rough, inout bool doubtful) {
    float s = rough.y, before = rough.x, edge = kFar;
    int left = reflections == 1 ? 34 : 2048;
    bool open = before < c.inside, hit = false;
    for (; left > 0 && open; --left) {
        s = min(s, c.inside);
        vec3 q = onLine(c.l, s);
        vec2 z = vec2(onLine(c.l, before).z, q.z);
        vec4 texel = shownIn(q.xy);
        ++walkFetches;
        float slack = abs(z.y - z.x), deep = length(texel.xyz);
        bool facing = dot(texel.xyz, c.own) < 0.999 * deep;   // as the start does: never met
        hit = max(z.x, z.y) > texel.w + bias && behindThing(texel, min(z.x, z.y)) < slack
            && facing && dot(texel.xyz, rd) < 0.7 * deep;
        float least = abs(z.y - z.x) + (rd.y < 0.0 ? 0.05 * z.y : 0.0);   // m, over water
        bool close = texel.w - z.y < (facing && deep < 10.0 ? 0.3 : least);
        bool between = edge < kFar && !close && !facing && deep < 10.0 && texel.w - z.y < 0.15;
        doubtful = doubtful || !hit && (texel.w > edge || between || s >= c.inside && close);
        edge = close && deep < 10.0 ? texel.w + 0.1 : kFar;
        open = !hit && s < c.inside;
        if (open) {
            before = s > c.gap.x ? max(s, c.gap.y) : s;
            s = before + c.perStep;
        }
    }
    rough = vec2(before, s);
    return hit;
}

// The place in the last step, by halving: first with depth interpolated between pixels, since at a
// grazing view half a pixel is metres of water; over an edge, where that lies, by whole pixels.
// end: where it lies; astray: neither fits.
vec3 closeIn(Course c, vec3 rd, bool hit, vec2 rough, out float end, out bool astray) {
    vec2 fine = rough + vec2(-6.0, 2.0) * c.perPixel;
    fine = vec2(max(fine.x, min(c.start, rough.y)), min(fine.y, c.inside));
    for (int j = 0; j < 6; ++j) {
        float m = 0.5 * (fine.x + fine.y);
        vec3 q = onLine(c.l, m);
        if (q.z > smoothAt(q.xy)) fine.y = m;
        else fine.x = m;
    }
    end = fine.y;
    vec3 q = onLine(c.l, fine.y);
    vec4 texel = shownIn(q.xy);
    astray = behindThing(texel, q.z) > 0.0 || dot(texel.xyz, rd) > 0.0;
    for (int j = 0; j < 5 && astray && hit; ++j) {
        float m = 0.5 * (rough.x + rough.y);
        q = onLine(c.l, m);
        if (q.z > shownIn(q.xy).w) rough.y = m;
        else rough.x = m;
        ++walkFetches;
    }
    if (astray) {
        q = onLine(c.l, rough.y);
        texel = shownIn(q.xy);
        float deep = length(texel.xyz);
        astray = q.z - texel.w > 0.025 || dot(texel.xyz, rd) > 0.3 * deep
            || dot(texel.xyz, c.own) > 0.999 * deep;
    }
    return q;
}

// Walks the depth buffer along a ray. found: the pixel that it meets; the value: how sure, 0 for a
// miss. doubtful: the picture does not tell for certain.
float walkScreen(Eye e, vec3 ro, vec3 rd, float chance, bool wanted, out vec2 found,
                 out bool doubtful) {
    found = vec2(0.0);
    doubtful = false;
    walkFetches = 0;
    Course c;
    if (!wanted || !plotCourse(e, ro, rd, c)) return 0.0;
    float first = c.perStep * (1.0 - jitter * chance), end;
    vec2 rough = vec2(min(c.start, first), first);
    bool hit = marchCourse(c, rd, rough, doubtful), astray;
    vec3 q = closeIn(c, rd, hit, rough, end, astray);
    if (!hit) { doubtful = doubtful || c.inside < 2.0 * c.perPixel; return 0.0; }   // small: all edges
    // How far below what is shown the ray is two pixels on: too little, and the place is vague.
    vec3 on = onLine(c.l, min(end + 2.0 * c.perPixel, 1.0));
    vec2 shown = vec2(smoothAt(q.xy), smoothAt(on.xy));
    walkFetches += 9;
    doubtful = doubtful || astray || on.z - shown.y < 1.2 * abs(shown.y - shown.x);
    found = q.xy;
    vec2 rim = min(q.xy, iResolution.xy - q.xy) / iResolution.xy;
    return smoothstep(0.0, max(edgeFade, 1e-4), min(rim.x, rim.y));
}

// ---- Passes and sound ---------------------------------------------------------------------------
// First the whole picture's geometry is drawn once, as two outputs of one pass: what each pixel is
// made of, and how it faces and how far it is. Then its light. Only then is the picture drawn,
// which reads both at any pixel: that is what rays on the screen walk through.

// Single scattering, with a share of light that has been scattered more often and comes from all
// around. x: sine of half the angle from the sun's azimuth, y: root of the sine of elevation.
void mainSky(out vec4 colour, in vec2 pixel) {
    vec2 uv = (pixel - 0.5) / vec2(255.0, 127.0);
    vec3 sun = sunDirection();
    float y = uv.y * uv.y, side = 1.0 - 2.0 * uv.x * uv.x, level = sqrt(max(1.0 - y * y, 0.0));
    float cosine = level * length(sun.xz) * side + y * sun.y;
    float far = airLength(1.0, y), g = 0.78;
    float rayleigh = 0.0596831 * (1.0 + cosine * cosine);
    float mie = 0.1193662 * (1.0 - g * g) * (1.0 + cosine * cosine)
        / ((2.0 + g * g) * pow(max(1.0 + g * g - 2.0 * g * cosine, 1e-3), 1.5));
    vec3 through = vec3(1.0), sum = vec3(0.0);
    for (int k = 0; k < 24; ++k) {
        float a = square(float(k) / 24.0), b = square(float(k + 1) / 24.0);
        float h = max(airHeight(1.0, y, 0.5 * (a + b) * far), 0.0), dt = (b - a) * far;
        vec3 density = airDensity(h), extinction = airExtinction(density);
        vec3 lost = exp(-extinction * dt);
        vec3 sunThere = airTransmittance(h, sun.y, 12), mean = pow(sunThere, vec3(0.4));
        vec3 scattered = kRayleigh * density.x * (rayleigh * sunThere + 0.028 * mean)
            + kMie * haze * density.y * (mie * sunThere + 0.028 * mean);
        sum += through * scattered * (1.0 - lost) / max(extinction, 1e-12);
        through *= lost;
    }
    colour = vec4(kSunPower * sum, 1.0);
}

// 0 to 5: light on a surface that faces -x +x -y +y -z +z, without the sun; 6: the sun's colour.
void mainAmbient(out vec4 colour, in vec2 pixel) {
    int face = int(pixel.x);
    colour = vec4(kSunPower * airTransmittance(1.0, sin(radians(sunHeight)), 32), 1.0);
    if (face > 5) return;
    vec3 axis = vec3(face / 2 == 0, face / 2 == 1, face / 2 == 2) * (float(face & 1) * 2.0 - 1.0);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 512; ++k) {
        float y = (float(k) + 0.5) / 256.0 - 1.0, a = 2.0 * kPi * kGolden * float(k);
        vec3 rd = vec3(sqrt(1.0 - y * y) * vec2(cos(a), sin(a)), y).xzy;
        float mirrored = y < 0.0 ? 0.04 + 0.96 * pow(1.0 + y, 4.0) : 1.0;   // in the sea
        vec3 light = clearSky(vec3(rd.x, abs(y), rd.z)) * mirrored;
        sum += light * max(dot(rd, axis), 0.0) * (4.0 * kPi / 512.0);
    }
    colour = vec4(sum, 1.0);
}
// Small buffers know by it how large the picture is, in whose pixels the mouse counts. Drawn once.
void mainScreen(out vec4 colour, in vec2 pixel) { colour = vec4(0.0); }
// 0 to 5: place and heading, then tilt, of the clusters. A float follows the waves averaged over
// its size. 6, 7: the eye and what it looks at.
void mainPoses(out vec4 colour, in vec2 pixel) {
    int k = int(pixel.x), c = k / 2;
    bool dragged = iMouse != vec4(0.0);   // the middle of the picture is the camera's own place
    vec2 orbit = dragged ? iMouse.xy / vec2(textureSize(screen, 0)) - 0.5 : vec2(0.0);
    float angle = radians(cameraAngle) - 2.0 * kPi * orbit.x;
    vec2 at = c == 0 ? vec2(-0.1, 0.0) : c == 1 ? vec2(-0.95, 0.75) : kMirrorAt.xz;
    if (c == 3) at = cameraDistance * vec2(sin(angle), cos(angle));
    float sway = 2.0 * kPi * cycles(0.0625);
    Sea s = sea(at, c == 3 ? vec3(0.01, 0.01, 0.0) : vec3(0.06, 0.06, 0.0));
    vec3 place = vec3(at, s.height - (c == 1 ? kSunk : 0.0)).xzy;
    float heading = c == 0 ? radians(rabbitAngle) + 0.10 * sin(sway)
        : 0.5 + 0.12 * sin(2.0 * sway + 1.0);
    vec2 tilt = s.slope * (c == 0 ? 0.9 : 0.4);
    if (c == 1) tilt += 0.16 * vec2(sin(heading), cos(heading));   // head up
    if (c == 2) {
        place = kMirrorAt;
        heading = radians(mirrorAngle);
        tilt = vec2(0.0);
    }
    if (c < 3) {
        colour = (k & 1) == 0 ? vec4(place, heading) : vec4(tilt, 0.0, 0.0);
    } else {
        float height = max(clamp(cameraHeight - 4.0 * orbit.y, 0.2, 6.0), s.height + 0.12);
        vec2 right = vec2(cos(angle), -sin(angle)) * targetShift;
        colour = k == 6 ? vec4(at, height, 0.0).xzyw : vec4(right, targetHeight, 0.0).xzyw;
    }
}

// albedo: colour, for water the lost slope variance; in w the kind of surface + a share of 1 of the
// light that comes through, for water of its slopes' tails. normalDepth: the normal, as long as the
// thing is deep behind the pixel, and 1 over the depth along the view's axis, which is linear over
// the picture of a plane: so half a pixel of a calm sea is exact, however grazing the view.
void mainGBuffer(out vec4 colour, out vec4 normal, in vec2 pixel) {
    readFrames();
    Eye e = camera();
    vec3 rd = viewRay(e, pixel);
    float angle = 1.0 / (e.lens * iResolution.y);
    float t = hitSea(e.pos, rd, angle, kFar);
    Hit h = hitThings(e.pos, rd, angle, t > 0.0 ? t : kFar);
    vec3 p = e.pos + h.t * rd;
    colour = vec4(0.0);
    normal = vec4(0.0, 1.0, 0.0, 0.0);
    if (h.id != kSky) {
        vec4 c = h.id == kGlass ? vec4(0.9) : paint(h.id, p, angle * h.t);
        colour = vec4(c.rgb, float(h.id) + 0.5 + 0.5 * clamp(c.w, -0.9, 0.9));
        float deep = depthOfThing(h.id, p, rd) * dot(rd, e.forward);
        normal = vec4(h.nor * deep, 1.0 / (h.t * dot(rd, e.forward)));
    } else if (t > 0.0) {
        p = e.pos + t * rd;
        Sea s = sea(p.xz, seaFootprint(rd, angle * t));
        colour = vec4(s.spread, float(kWater) + 0.5 + 0.5 * s.tails);
        normal = vec4(20.0 * normalize(vec3(-s.slope, 1.0).xzy), 1.0 / (t * dot(rd, e.forward)));
    }
}

// What a pixel shows first, and where it mirrors to with what share.
struct Surface { int id; float t; vec3 pos, nor, away; float mirrored; Sea sea; };
// The glass is ground off along its edge, which leans out there by a tenth.
vec3 bevelled(vec3 p, vec3 nor) {
    vec3 q = (p - frames[2].at) * frames[2].axes, edge = archField(q.xy);
    vec3 out1 = frames[2].axes * vec3(edge.xy, 0.0);
    return normalize(nor + (edge.z > -kBevel ? 0.10 : 0.0) * out1);
}
Surface surfaceAt(Eye e, vec3 rd, ivec2 pixel) {
    vec4 stuff = texelFetch(albedo, pixel, 0), facing = shownIn(vec2(pixel) + 0.5);
    vec3 nor = normalize(facing.xyz);
    Surface u;
    u.id = int(stuff.w);
    u.t = min(facing.w, 1e5) / dot(rd, e.forward);
    u.pos = e.pos + u.t * rd;
    u.nor = nor;
    u.sea = Sea(0.0, -nor.xz / max(nor.y, 1e-3), stuff.rgb, codeShare(stuff.w));
    if (u.id == kGlass) u.nor = nor = bevelled(u.pos, nor);
    u.mirrored = u.id == kGlass ? 0.95 : 1.0;
    u.away = u.id == kGlass ? normalize(reflect(rd, nor)) : rd;
    vec2 slope;
    shownSlope(rd, u.sea, slope);
    vec3 facet = normalize(vec3(-slope, 1.0).xzy), away = reflect(rd, facet);
    if (u.id == kWater) {   // biased: light between waves is left out, so none goes down
        u.mirrored = fresnel(clamp(-dot(facet, rd), 0.0, 1.0), kIorWater);
        u.away = normalize(vec3(away.x, max(away.y, 0.02), away.z));
    }
    return u;
}
// One of the rays that a blurred glass gathers, even over a disc round the mirrored one; none goes
// behind the glass.
vec3 blurredRay(vec3 away, vec3 nor, float k, vec2 start) {
    vec3 u = normalize(abs(away.y) < 0.9 ? vec3(away.z, 0.0, -away.x) : vec3(0.0, away.z, -away.y));
    float a = 2.0 * kPi * (kGolden * k + start.x);
    float r = mirrorBlur * sqrt((k + start.y) / float(mirrorRays));
    away += r * (cos(a) * u + sin(a) * cross(u, away));
    return normalize(away - min(2.0 * dot(away, nor), 0.0) * nor);
}

// Things: the light from them; water: in w the share of the sun that it sees.
void mainLight(out vec4 colour, in vec2 pixel) {
    readFrames();
    Eye e = camera();
    vec3 rd = viewRay(e, pixel), upWeight;
    vec4 stuff = texelFetch(albedo, ivec2(pixel), 0);
    vec4 facing = shownIn(pixel);
    int id = int(stuff.w);
    stuff.w = codeShare(stuff.w);
    vec3 nor = normalize(facing.xyz), p = e.pos + rd * (min(facing.w, 1e4) / dot(rd, e.forward));
    float behind = id == kFur && dot(nor, sunDirection()) < 0.0 ? max(stuff.w, 0.0) : 0.0;
    float chance = random3(ivec3(ivec2(pixel * 16.0), 5)).x;
    Look look = lookFrom(p, nor);
    float share = sunlight(p + 0.1 * behind * sunDirection(), nor, chance, look);
    vec3 light = thingLight(id, p, nor, rd, stuff, share, openness(look), upWeight);
    light += upWeight * mirrorSky(reflect(rd, nor), 0.05, false);
    light += rimLight(id, nor, rd, stuff, share);
    colour = vec4(light, share);
}

// Noise without much above rate / n, always the same for a sample: values on a lattice of n
// samples, joined by cubics. Left and right differ.
vec2 latticeNoise(int samp, int n, int seed) {
    int c = samp / n;
    float f = (float(samp - c * n) + 0.5) / float(n);
    vec2 a = random3(ivec3(c, n, seed)).xy, b = random3(ivec3(c + 1, n, seed)).xy;
    return 2.0 * mix(a, b, f * f * (3.0 - 2.0 * f)) - 1.0;
}
// Surf as loud and bright as the long waves are high to the left and right of the middle, small
// waves that lap at the lifebuoy, and wind in gusts. Nothing has a state: any sample can be first.
vec2 mainSound(int samp, float time) {
    uint tick = uint(samp / 44100) * 65536u + uint(samp % 44100) * 65536u / 44100u;
    vec2 swell = vec2(0.0), lap = vec2(0.0);
    for (int g = 0; g < kMovers; ++g) {
        vec4 x, z;
        waveVectors(g, x, z);
        vec4 k = sqrt(x * x + z * z), a = kWaveSteep[g] / k;
        for (int ear = 0; ear < 2; ++ear) {
            vec4 c = cos(x * (float(ear) * 3.0 - 1.5) - 2.0 * kPi * waveTurns(k, tick));
            swell[ear] += g == 0 ? dot(a, c) / 0.19 : 0.0;
            lap[ear] += g == 1 ? dot(vec4(0.25), c) : 0.0;
        }
    }
    vec2 loud = smoothstep(-0.6, 1.0, swell) * min(waveHeight, 1.5), bright = loud * loud;
    vec2 sum = vec2(0.0);
    for (int k = 1; k <= 7; ++k) {   // octaves; crests hiss, troughs rumble
        float low = float(k - 1) / 6.0;
        sum += latticeNoise(samp, 1 << k, k) * mix(0.03 + 0.20 * bright, 0.10 + 0.25 * loud, low);
    }
    vec2 drops = latticeNoise(samp, 23, 11) * latticeNoise(samp, 3000, 12);
    sum += 0.9 * drops * square(max(lap.x, 0.0)) * square(ripples);
    float gusts = 0.5 + 0.5 * latticeNoise(samp, 132300, 13).x;
    vec2 wind = latticeNoise(samp, 61, 14) + 0.6 * latticeNoise(samp, 37, 15) * gusts;
    sum += wind * (0.10 + 0.22 * gusts * gusts);
    float fade = smoothstep(0.0, 0.5, time);
    return 0.5 * fade * sum / (1.0 + 0.5 * abs(sum));
}

// ---- Image --------------------------------------------------------------------------------------
// Each pixel is a thing, whose light is known already, or water, glass or sky, which show something
// else: one ray is sent on (several, where the glass blurs), and what it meets is mixed over the
// sky.

// What hides the bands of a smooth picture of 255 steps: half a step, up or down by chance. It is
// the same for all samples of a pixel: their mean is rounded, and of many none would be left.
vec3 dither(vec2 fragCoord) {
    vec3 chance = random3(ivec3(16 * ivec2(fragCoord) + 8, 3));
    return (chance + chance.yzx - 1.0) * (0.5 / 255.0);
}

// Light to display: clamped first, then the largest channel rolls off, the others keep their ratio
// to it, with a little white at the top as on film; then sRGB. NaN and negatives 0, infinity 1.
vec3 display(vec3 light) {
    vec3 x = mix(vec3(0.0), min(light, 65504.0), greaterThan(light, vec3(0.0)));
    float peak = max(maxComponent(x), 1e-6), rolled = 1.0 - exp(-peak);
    vec3 c = mix(x * (rolled / peak), vec3(rolled), 0.35 * pow(rolled, 12.0));
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(max(c, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// What a mirrored ray meets.
struct Met {
    vec3 thing;    // light of a thing
    float sure;    // how sure that is, over sea and sky
    bool wet;      // water, seen in the glass
    float far;     // m
    vec3 glass;    // normal of a glass, 0 for none
};
// The two rays of a pixel that are traced: one mirrored (above), where the picture does not tell
// what it meets, and, of a pixel of water, one that goes on down into it (below). Loops over both
// trace and light them: a driver compiles a copy of a function for each place that calls it.
struct Traced { vec3 from, way; float end; Hit hit; vec3 light; };
void traceThings(float angle, int first, int last, inout Traced above, inout Traced below) {
    for (int k = first; k <= last; ++k) {
        vec3 ro = k == 0 ? above.from : below.from, rd = k == 0 ? above.way : below.way;
        Hit h = hitThings(ro, rd, angle, k == 0 ? above.end : below.end);
        if (k == 0) above.hit = h;
        else below.hit = h;
    }
}
void lightThings(Surface u, float angle, float cone, float chance, int first, int last,
                 inout Traced above, inout Traced below) {
    vec3 p = above.from + min(above.hit.t, 1e4) * above.way, upWeight;
    float share = 1.0, open = 0.8;
    // No `if`: a driver that draws eight pixels in step runs both sides of one for all of them, and
    // throws away what was not wanted. A loop ends when none of them is left in it: where no pixel
    // is in doubt, nothing is traced.
    while (first == 0) { //@ allow loop-without-bound
        Look look = lookFrom(p, above.hit.nor);
        share = sunlight(p, above.hit.nor, chance, look);
        open = openness(look);
        break;
    }
    for (int k = first; k <= last; ++k) {
        Hit h = below.hit; if (k == 0) h = above.hit;   // WebGL has no ?: of structs
        vec3 q = k == 0 ? p : u.pos + h.t * below.way, rd = k == 0 ? above.way : below.way;
        vec4 stuff = paint(h.id, q, angle * u.t + (k == 0 ? (angle + cone) * h.t : 0.0));
        float sunny = k == 0 ? share : 1.0, around = k == 0 ? open : 0.8;
        vec3 light = thingLight(h.id, q, h.nor, rd, stuff, sunny, around, upWeight);
        if (k == 0)
            above.light = light + rimLight(h.id, h.nor, rd, stuff, share)
                + upWeight * ambientLight(h.nor) / kPi;
        else
            below.light = light;
    }
}
// By the traced ray. wet: where it meets the sea, if it does.
Met metExactly(Traced above, float wet) {
    Hit h = above.hit;
    return Met(above.light, h.id > kGlass ? 1.0 : 0.0, h.id == kSky && wet > 0.0, h.t,
               h.id == kGlass ? h.nor : vec3(0.0));
}
// By the pixel that shows it. s: the sea where the ray comes to it; the picture's own, where that
// is sure.
void metInPicture(vec2 found, bool onGlass, inout Met m, inout Sea s) {
    vec4 stuff = texelFetch(albedo, ivec2(found), 0);
    vec3 nor = texelFetch(normalDepth, ivec2(found), 0).xyz;
    nor = normalize(nor + vec3(0.0, 1e-6, 0.0));
    m.thing = texelFetch(lightBuffer, ivec2(found), 0).rgb;
    int id = m.sure > 0.0 ? int(stuff.w) : kSky;
    if (id == kGlass) m.glass = nor;
    if (id == kWater) {
        s.slope = mix(s.slope, -nor.xz / max(nor.y, 1e-3), m.sure);
        s.spread = mix(s.spread, stuff.rgb, m.sure);
        s.tails = mix(s.tails, codeShare(stuff.w), m.sure);
        m.wet = onGlass;
    }
    if (id <= kGlass) m.sure = 0.0;
}

// Light along one mirrored ray, or from the open sky along the view's own. cone: of it, rad; below:
// the ray that goes down into water.
vec3 mirroredLight(Eye e, Surface u, vec3 away, float angle, float cone, vec2 chance,
                   inout Traced below) {
    bool onSea = u.id == kWater, onGlass = u.id == kGlass, exact = reflections == 3;
    vec3 from = u.pos + 0.002 * u.nor, light = vec3(0.0), upWeight = vec3(1.0);
    Met m = Met(vec3(0.0), 0.0, onGlass && away.y < -1e-3 && u.pos.y > 0.0,
                -u.pos.y / min(away.y, -1e-4), vec3(0.0));
    vec2 found = vec2(0.0), leaning;
    if (reflections == 1 || reflections == 2)
        m.sure = walkScreen(e, from, away, chance.x, onSea || onGlass, found, exact);
    // Glass mirrors the sea, too; waves only what stands in it.
    float wet = hitSea(from, away, angle, exact && onGlass ? kFar : 0.0);
    Traced above = Traced(from, away, wet > 0.0 ? wet : kFar, kNothing, vec3(0.0));
    int first = exact && (onSea || onGlass) ? 0 : 1, last = onSea ? 1 : 0;
    traceThings(angle, first, last, above, below);
    lightThings(u, angle, cone, chance.y, first, last, above, below);
    if (exact) m = metExactly(above, wet);
    m.far = min(m.far, 1e5);
    vec3 q = u.pos + m.far * away;
    Sea s = sea(q.xz, seaFootprint(away, angle * u.t + (angle + cone) * m.far));
    if (!exact) metInPicture(found, onGlass, m, s);
    float shown = shownSlope(away, s, leaning);
    if (m.wet) {
        vec3 n = normalize(vec3(-leaning, 1.0).xzy);
        float f = fresnel(clamp(-dot(n, away), 0.0, 1.0), kIorWater);
        light = sunBeam() * seaGlitter(away, s, shown) + (1.0 - f) * deepLight();
        upWeight = vec3(f);
        away = reflect(away, n);
    }
    if (m.glass != vec3(0.0)) away = reflect(away, m.glass);
    bool disc = u.id == kSky || onGlass && !m.wet;
    light += upWeight * mirrorSky(away, onSea ? 0.1 : angle + cone, disc);
    return mix(light, m.thing, m.sure);
}

vec3 refracted(vec3 rd, vec3 nor) {   // into the water
    float eta = 1.0 / kIorWater, c = clamp(-dot(rd, nor), 0.0, 1.0);
    float k2 = (1.0 - eta) * (1.0 + eta) + square(eta * c);
    return normalize(eta * rd + (eta * c - sqrt(k2)) * nor);
}
// What is seen through the water: rabbits and frame below the waterline, or the deep. Light is lost
// on the way up to the eye, and on its own way down.
vec3 throughSea(Surface u, Traced below) {
    Hit h = below.hit;
    float sunk = -(u.pos + h.t * below.way).y;
    vec3 left = exp(-kAbsorption / clarity * (h.t + 1.5 * max(sunk, 0.0)));
    return mix(deepLight(), below.light, h.id > kGlass ? left : vec3(0.0));
}

// Light through a crest: the sun behind it goes a short way through the water at its top, and comes
// out where its face leans towards the eye.
vec3 crestGlow(Surface u, vec3 rd) {
    vec2 sun = normalize(sunDirection().xz + vec2(0.0, 1e-9));
    float behind = 0.5 + 0.5 * dot(normalize(rd.xz + vec2(0.0, 1e-9)), sun);
    float thin = smoothstep(-0.05, 0.16, u.pos.y), leans = max(-dot(u.nor.xz, rd.xz), 0.0);
    return sunBeam() * linearColour(waterColour)
        * (kGlow * square(behind) * thin * leans * exp(-u.t / 12.0));
}
// Metres on the water from a point to where it laps at something.
float toThings(vec3 p) {
    float far = 1.0;
    if (clusterThere(0)) far = abs(distance(p.xz, frames[0].at.xz) - 0.305) - 0.087;
    if (clusterThere(1)) {
        vec3 q = (p - frames[1].at) * frames[1].axes;
        vec4 body = ellipsoid(q - vec3(0.0, 0.17, -0.03), vec3(0.185, 0.20, 0.20));
        vec4 chest = ellipsoid(q - vec3(0.0, 0.28, 0.05), vec3(0.125, 0.14, 0.115));
        far = min(far, join(body, chest, 0.08).w);
    }
    if (clusterThere(2)) {
        vec2 q = ((p - frames[2].at) * frames[2].axes).xz;
        far = min(far, max(length(vec2(max(abs(q.x) - kArch, 0.0), q.y)) - 0.2 * kTube, 0.0));
        far = min(far, length(vec2(abs(q.x) - kArch, q.y)) - kTube);
    }
    return far;
}
// Foam there: a rim of bubbles, and torn lace beyond it. w: footprint of the pixel, m.
float lapping(Surface u, float w) {
    float far = max(toThings(u.pos), 0.0);
    if (far > 0.16) return 0.0;
    vec2 at = 42.0 * u.pos.xz + vec2(2.0 * sin(2.0 * kPi * cycles(0.125)), 512.0);
    float lace = 0.0;
    for (int k = 0; k < 2; ++k)
        lace += (k == 0 ? 0.6 : 0.4)
            * cloudNoise((k == 0 ? 1.0 : 2.3) * at, k == 0 ? 1024 : 4096, 61 + k);
    float amount = 0.60 * exp(-far / 0.025), soft = 0.08 + 4.0 * w;
    float torn = smoothstep(1.0 - amount - soft, 1.0 - amount + soft, lace + 0.2);
    float rim = 1.0 - smoothstep(0.0, 0.008 + w, far);
    return max(0.7 * torn, 0.5 * rim);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    readFrames();
    Eye e = camera();
    vec3 rd = viewRay(e, fragCoord), chance = random3(ivec3(ivec2(fragCoord * 16.0), 3));
    float angle = 1.0 / (e.lens * iResolution.y);
    Surface u = surfaceAt(e, rd, ivec2(fragCoord));
    vec4 lit = texelFetch(lightBuffer, ivec2(fragCoord), 0);
    vec3 sum = vec3(0.0), down = refracted(rd, u.nor);
    Traced below = Traced(u.pos + 1e-4 * down, down, kSeenDeep, kNothing, vec3(0.0));
    bool blurred = u.id == kGlass && mirrorBlur > 0.0;
    int rays = blurred ? mirrorRays : 1;
    float cone = blurred ? 1.4 * mirrorBlur * inversesqrt(float(rays)) : 0.0;   // of one ray, rad
    // R2 from pixel to pixel; evenly apart among the samples of one.
    float spin = fract(dot(floor(fragCoord), vec2(0.7548777, 0.5698403)) + fragCoord.x);
    for (int k = 0; k < rays; ++k) {
        vec3 away = u.away;
        if (blurred) away = blurredRay(away, u.nor, float(k), vec2(spin, chance.z));
        sum += u.mirrored / float(rays) * mirroredLight(e, u, away, angle, cone, chance.xy, below);
    }
    if (u.id > kGlass) sum = lit.rgb;
    if (u.id == kWater) {
        sum += (1.0 - u.mirrored) * (throughSea(u, below) + crestGlow(u, rd));
        vec2 slope;
        sum += sunBeam() * (lit.w * seaGlitter(rd, u.sea, shownSlope(rd, u.sea, slope)));
        float lit1 = lit.w * max(dot(u.nor, sunDirection()), 0.0);
        vec3 snow = 0.8 / kPi * (ambientLight(u.nor) + lit1 * sunBeam());
        sum = mix(sum, snow, lapping(u, angle * u.t));
        vec3 level = normalize(vec3(rd.x, 1e-3, rd.z));   // the air in between
        sum = mix(clearSky(level), sum, exp(-4e-5 * haze * u.t));
    }
    fragColor = vec4(display(exp2(exposure) * sum) + dither(fragCoord), 1.0);
}
