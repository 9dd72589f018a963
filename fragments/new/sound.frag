// A scene to begin with: a tune, and a picture of it. mainSound() gives the left and the right ear a
// number from -1 to 1, 44,100 times a second.
//
// Save this file while the window is open: picture and sound follow at once, and the sliders stay where
// they are. `Ctrl+M` is silence; `glint sound` writes the sound to a file.

// A uniform whose comment begins with //@ is a slider. Its default stands first, its range in brackets,
// what it does in quotes; `unit` is shown behind the number. `log` gives small values as much of the
// slider as large ones.
uniform float tempo; //@ 4 [1, 12] unit=1/s "notes"
uniform float pitch; //@ 220 [55, 880] log unit=Hz "of the lowest note"
uniform float ring;  //@ 0.35 [0.05, 2] log unit=s "how long a string sounds"
uniform float loud;  //@ 0.5 [0, 1] "loudness"
// A vec3 with a # is a colour.
uniform vec3  glow;  //@ #7bdff2 "colour of the wave"

const float kTurn = 6.2831853;  // radians

// Half tones above the lowest note: a chord, up and down.
const int kTune[8] = int[8](0, 7, 12, 16, 19, 16, 12, 7);

// One string, plucked `since` seconds ago: higher tones die sooner.
float pluck(float frequency, float since) {
    float sum = 0.0;
    for (int k = 1; k <= 5; ++k) {
        // The phase is taken modulo a turn before sin(), which keeps its digits.
        float phase = fract(frequency * float(k) * since);
        sum += sin(kTurn * phase) * exp(-since * float(k) / ring) / float(k);
    }
    return 0.5 * sum * min(since * 400.0, 1.0);  // no click at the start
}

float frequencyOf(int note) {
    return pitch * exp2(float(kTune[note % 8]) / 12.0);
}

// The samples of a note, of which there are 44,100 a second.
int noteLength() {
    return int(44100.0 / tempo);
}

// The note that sounds, and the one before it, which still rings, at a sample of the tune. Counting in
// whole numbers keeps the tune as exact after ten hours as at its start.
vec2 tune(int samp) {
    int size = noteLength(), note = samp / size;
    float since = float(samp % size) / 44100.0;
    float now = pluck(frequencyOf(note), since);
    float before = pluck(frequencyOf(note + 7), since + float(size) / 44100.0);
    return loud * vec2(0.7 * now + 0.4 * before, 0.4 * now + 0.7 * before);
}

// From 0 to 1, so many times a second. iTick counts time in 1/65536 s: whole numbers are as exact after
// a year as in the first second, where sin(iTime) has lost its digits.
float turns(float hz) {
    return float(uint(int(hz * 65536.0)) * iTick) / 4294967296.0;
}

vec2 mainSound(int samp, float time) {
    return tune(samp % (8 * noteLength()));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    // The 40 ms that are heard now, from left to right, as an oscilloscope shows them.
    float beat = 8.0 * turns(44100.0 / float(8 * noteLength()));
    int samp = int((beat * float(noteLength())) + 1764.0 * fragCoord.x / iResolution.x);
    float line = 0.012 / (0.012 + abs(p.y - tune(samp).x));
    // A bar a note; the one that sounds is bright.
    int bar = min(int(8.0 * fragCoord.x / iResolution.x), 7);
    float height = -0.95 + 0.02 * float(kTune[bar] + 3);
    float lit = p.y < height ? (bar == int(beat) % 8 ? exp(-fract(beat)) : 0.15) : 0.0;
    vec3 color = vec3(0.03, 0.04, 0.07) + glow * (line + lit);
    fragColor = vec4(1.0 - exp(-1.5 * color), 1.0);
}
