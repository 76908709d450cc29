// The ray for a pixel's shadow. Pixels four apart share it: no vectors.

const float kLightRadius = 0.09F; // seen from a point, as a tangent (tuned by eye: shadows of contacts stay clear)

// Direction to a point of the light, any length, y up and z towards the eye; w: offset of the first step. `turned`:
// from 0 to 1, selects other points and offsets.
vec4 shadow_ray(int column, int row, float turned) {
    float number = first_turn(column, row) * (1.0F / 0.39269908F); // 0 to 15
    float angle = 2.39996323F * number + 6.2831853F * turned; // sixteen points evenly over a disc
    float radius = kLightRadius * sqrt((number + 0.5F) * (1.0F / 16.0F));
    float across = radius * cos(angle), up = radius * sin(angle);
    float step = 0.4375F * number + 0.0625F * turned + 0.03125F; // multiples of 7/16: far apart where points are close
    return vec4(-0.429F + 0.8F * across - 0.4194F * up, 0.572F + 0.6F * across + 0.5592F * up, 0.699F - 0.715F * up,
                step - floor(step));
}
