#pragma once
// Embree 3 and 4 by one set of names. Not for use elsewhere. A query's filter and its user data travel in a
// context in Embree 3, in arguments beside the context in Embree 4.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace dermis::inline rays {

#if RTC_VERSION_MAJOR >= 4

using EmbreeContext = RTCRayQueryContext;

inline constexpr RTCSceneFlags kEmbreeQueryFilters = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init_embree_context(EmbreeContext* context) {
    rtcInitRayQueryContext(context);
}

/// `filter` is called for every hit; null: only the filters of the geometries are.
inline void embree_intersect(RTCScene scene, EmbreeContext* context, RTCRayHit* query,
                             RTCFilterFunctionN filter = nullptr) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = context;
    arguments.filter = filter;
    if (filter) arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    rtcIntersect1(scene, query, &arguments);
}

inline void embree_occluded(RTCScene scene, EmbreeContext* context, RTCRay* query) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = context;
    rtcOccluded1(scene, query, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;

inline constexpr RTCSceneFlags kEmbreeQueryFilters = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init_embree_context(EmbreeContext* context) {
    rtcInitIntersectContext(context);
}

inline void embree_intersect(RTCScene scene, EmbreeContext* context, RTCRayHit* query,
                             RTCFilterFunctionN filter = nullptr) {
    context->filter = filter;
    rtcIntersect1(scene, context, query);
}

inline void embree_occluded(RTCScene scene, EmbreeContext* context, RTCRay* query) {
    rtcOccluded1(scene, context, query);
}

#endif

}  // namespace dermis::inline rays
