// Files of every kind, side by side; tests/web/page makes them.
uniform sampler2D song;    //@ sound song.wav
uniform samplerCube room;  //@ cube room.exr
uniform sampler3D cloud;   //@ volume cloud.bin
uniform sampler2D letters; //@ image letters.png filter=mipmap

void mainImage(out vec4 color, in vec2 coord) {
    vec2 p = coord / iResolution.xy;
    if (p.x < 0.25)
        color = vec4(texture(song, vec2(p.y, 0.25)).r, texture(song, vec2(p.y, 0.75)).r, 0.0, 1.0);
    else if (p.x < 0.5)
        color = texture(room, vec3(p * 2.0 - 1.0, 0.5));
    else
        color = p.x < 0.75 ? vec4(texture(cloud, vec3(p * 4.0, iTime)).r) : textureLod(letters, p * 3.0, 1.0);
}
