/* A small host of PINS modules: loads one twice, as two workers that share chunks, and lets them make
 * the steps of every other state each, breadth first. Prints what the whole space has.
 *
 *     host MODULE.so MOST
 *
 * The output: `states`, `transitions`, `deadlocks` of states that run, a line `fails STATUS` for each
 * step into a failure, and for each label in how many states it holds. It ends with status 2 after
 * MOST states.
 */
#include <dlfcn.h>
#include <stdio.h>

#include <ltsmin/dlopen-api.h>
#include <ltsmin/pins-util.h>

enum { TYPES = 64, WORKERS = 2, LABELS = 64 };

struct lts_type_s {
    int length, types, labels, edge_labels, types_of_slots[TYPES];
    char *names[TYPES], *slots[TYPES], *label_names[LABELS];
    data_format_t formats[TYPES];
};

struct grey_box_model {
    void *context;
    lts_type_t type;
    matrix_t *steps, *labels;
    int initial[TYPES];
    next_method_grey_t next;
    get_label_method_t label;
};

/* The chunks of each type, shared by the workers. */
static struct table {
    chunk *chunks;
    int count, room;
} tables[TYPES];

static void *some(void *memory)
{
    if (!memory)
        abort();
    return memory;
}

static void must(int holds, const char *what)
{
    if (holds)
        return;
    fprintf(stderr, "host: %s\n", what);
    exit(3);
}

/* --- types */

lts_type_t lts_type_create()
{
    return some(calloc(1, sizeof(struct lts_type_s)));
}

int lts_type_find_type(lts_type_t t, const char *name)
{
    for (int i = 0; i < t->types; i++)
        if (!strcmp(t->names[i], name))
            return i;
    return -1;
}

int lts_type_put_type(lts_type_t t, const char *name, data_format_t format, int *is_new)
{
    must(lts_type_find_type(t, name) < 0 && t->types < TYPES && !is_new, "types differ");
    t->names[t->types] = some(strdup(name));
    t->formats[t->types] = format;
    return t->types++;
}

void lts_type_set_state_length(lts_type_t t, int length)
{
    must(length <= TYPES, "a short state");
    t->length = length;
}

void lts_type_set_state_name(lts_type_t t, int idx, const char *name)
{
    must(idx < t->length, "a slot of the state");
    t->slots[idx] = some(strdup(name));
}

void lts_type_set_state_typeno(lts_type_t t, int idx, int typeno)
{
    must(idx < t->length && typeno < t->types, "a type of the state");
    t->types_of_slots[idx] = typeno;
}

void lts_type_set_state_label_count(lts_type_t t, int count)
{
    must(count <= LABELS, "few labels");
    t->labels = count;
}

void lts_type_set_state_label_name(lts_type_t t, int label, const char *name)
{
    t->label_names[label] = some(strdup(name));
}

void lts_type_set_state_label_typeno(lts_type_t t, int label, int typeno)
{
    must(label < t->labels && t->formats[typeno] == LTStypeBool, "labels are true or false");
}

void lts_type_set_edge_label_count(lts_type_t t, int count)
{
    t->edge_labels = count;
}

void lts_type_set_edge_label_name(lts_type_t t, int label, const char *name)
{
    must(label < t->edge_labels && *name, "names of edges");
}

void lts_type_set_edge_label_typeno(lts_type_t t, int label, int typeno)
{
    must(label < t->edge_labels && typeno < t->types, "types of edges");
}

void lts_type_validate(lts_type_t t)
{
    for (int i = 0; i < t->length; i++)
        must(t->slots[i] != NULL, "a name for each slot");
    for (int i = 0; i < t->labels; i++)
        must(t->label_names[i] != NULL, "a name for each label");
}

/* --- what a module says of itself */

void dm_create(matrix_t *m, const int rows, const int cols)
{
    m->rows = rows;
    m->cols = cols;
}

void dm_set(matrix_t *m, const int row, const int col)
{
    must(row < m->rows && col < m->cols, "a place of the matrix");
}

void GBsetContext(model_t model, void *context)
{
    model->context = context;
}

void *GBgetContext(model_t model)
{
    return model->context;
}

void GBsetLTStype(model_t model, lts_type_t info)
{
    model->type = info;
}

void GBsetDMInfo(model_t model, matrix_t *dm_info)
{
    must(dm_info->rows == 1 && dm_info->cols == model->type->length, "one group");
    model->steps = dm_info;
}

void GBsetStateLabelInfo(model_t model, matrix_t *sl_info)
{
    must(sl_info->rows == model->type->labels, "a row for each label");
    model->labels = sl_info;
}

void GBsetInitialState(model_t model, int *state)
{
    memcpy(model->initial, state, (size_t)model->type->length * sizeof *state);
}

void GBsetNextStateLong(model_t model, next_method_grey_t method)
{
    model->next = method;
}

void GBsetStateLabelLong(model_t model, get_label_method_t method)
{
    model->label = method;
}

void ltsmin_abort(int code)
{
    exit(code);
}

/* --- chunks */

static int is_chunk(const chunk *known, const chunk *c)
{
    return known->data && known->len == c->len && !memcmp(known->data, c->data, c->len);
}

void pins_chunk_put_at(model_t model, int type_no, const chunk c, int index)
{
    struct table *t = tables + type_no;
    must(model->type != NULL, "the type before chunks");
    must(index <= t->count && (index == t->count || is_chunk(t->chunks + index, &c)), "equal workers");
    if (index == t->count)
        must(pins_chunk_put(model, type_no, c) == index, "values that differ");
}

int pins_chunk_put(model_t model, int type_no, const chunk c)
{
    struct table *t = tables + type_no;
    must(model->type != NULL, "the type before chunks");
    for (int i = 0; i < t->count; i++)
        if (is_chunk(t->chunks + i, &c))
            return i;
    if (t->count == t->room) {
        t->room = 2 * t->room + 16;
        t->chunks = some(realloc(t->chunks, (size_t)t->room * sizeof *t->chunks));
    }
    chunk copy = {c.len, some(malloc(c.len + 1))};
    memcpy(copy.data, c.data, c.len);
    t->chunks[t->count] = copy;
    return t->count++;
}

chunk pins_chunk_get(model_t model, int type_no, int index)
{
    must(model->type != NULL && index < tables[type_no].count, "a chunk that is known");
    return tables[type_no].chunks[index];
}

/* --- the space */

static struct space {
    int length, *states, *table;
    size_t count, room, slots, most, transitions, running, deadlocks;
} space;

static size_t slot_of(const int *state)
{
    uint64_t hash = 1469598103934665603u;
    for (int i = 0; i < space.length; i++)
        hash = (hash ^ (uint32_t)state[i]) * 1099511628211u;
    size_t at = (size_t)(hash ^ hash >> 32) % space.slots;
    size_t size = (size_t)space.length * sizeof *state;
    while (space.table[at] && memcmp(space.states + (space.table[at] - 1) * space.length, state, size))
        at = (at + 1) % space.slots;
    return at;
}

static void visit(const int *state)
{
    size_t at = slot_of(state), size = (size_t)space.length * sizeof *state;
    if (space.table[at])
        return;
    if (space.count == space.most)
        exit(2);
    memcpy(space.states + space.count * (size_t)space.length, state, size);
    space.table[at] = (int)++space.count;
}

static const char *status_of(model_t model, const int *state)
{
    int slot = model->type->length - 1;
    return tables[model->type->types_of_slots[slot]].chunks[state[slot]].data;
}

struct step {
    model_t model;
    int *from, count, fails;
};

static void take(void *context, transition_info_t *info, int *to, int *written)
{
    struct step *s = context;
    must(info->labels[1] >= 0 && info->group == 0 && !written, "a step");
    s->count++;
    if (!strncmp(status_of(s->model, s->from), "runs", 4) ||
        !strncmp(status_of(s->model, s->from), "start", 5)) {
        s->fails = strncmp(status_of(s->model, to), "runs", 4);
        if (s->fails)
            printf("fails %s\n", status_of(s->model, to));
    }
    visit(to);
}

static void explore(model_t *workers)
{
    int *from = some(malloc((size_t)space.length * sizeof *from));
    for (size_t i = 0; i < space.count; i++) {
        model_t model = workers[i % WORKERS];
        memcpy(from, space.states + i * (size_t)space.length, (size_t)space.length * sizeof *from);
        struct step step = {model, from, 0, 0};
        int said = model->next(model, 0, from, take, &step);
        must(said == step.count, "as many steps as it says");
        if (strcmp(status_of(model, from), "runs"))
            continue;
        space.running++;
        space.transitions += (size_t)step.count;
        space.deadlocks += !step.count;
    }
}

static void tell_labels(model_t model)
{
    for (int label = 0; label < model->type->labels; label++) {
        size_t holds = 0;
        for (size_t i = 0; i < space.count; i++) {
            int *state = space.states + i * (size_t)space.length;
            if (!strcmp(status_of(model, state), "runs"))
                holds += model->label(model, label, state) == 1;
        }
        printf("label %s %zu\n", model->type->label_names[label], holds);
    }
}

int main(int count, char **arguments)
{
    must(count == 3, "a module and a bound");
    void *library = dlopen(arguments[1], RTLD_NOW);
    must(library != NULL, dlerror());
    void (*init)(model_t) = (void (*)(model_t))dlsym(library, "pins_model_init");
    must(init && dlsym(library, "pins_plugin_name"), "what a module has");
    model_t workers[WORKERS];
    for (int w = 0; w < WORKERS; w++) {
        workers[w] = some(calloc(1, sizeof *workers[w]));
        init(workers[w]);
        must(!memcmp(workers[w]->initial, workers[0]->initial, sizeof workers[0]->initial), "one start");
    }
    space.most = (size_t)atol(arguments[2]);
    space.length = workers[0]->type->length;
    space.slots = 2 * space.most + 1;
    space.states = some(malloc((space.most + 1) * (size_t)space.length * sizeof *space.states));
    space.table = some(calloc(space.slots, sizeof *space.table));
    visit(workers[0]->initial);
    explore(workers);
    printf("states %zu\ntransitions %zu\ndeadlocks %zu\n", space.running, space.transitions, space.deadlocks);
    tell_labels(workers[1]);
    return 0;
}
