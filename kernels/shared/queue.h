// Work queues: how lists are compacted in order, the same way whatever the number of groups.
#ifndef SUNDOG_SHARED_QUEUE_H
#define SUNDOG_SHARED_QUEUE_H
#include "shared/platform.h"
SHARED_BEGIN

// Items that one work-item counts and writes.
#define FLAG_CHUNK 256u

SHARED_END
#endif
