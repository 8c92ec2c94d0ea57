// Where the shadow map of a light is read, for the light that has entered around a point: along two tangents and off the surface, in
// mm; weights of red, green, blue, and of the penumbra alone.

export const shadowPlaces = [
  @shadow_places@
];

// Where so many of them agree with the filtered shadow, the others are not read.
export const firstPlaces = @first_shadow_places@;

// Places on the disk that a shadow's edge is filtered with.
export const diskPlaces = @shadow_taps@;
