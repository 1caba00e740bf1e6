/** Studies that come with the product, to begin with. */
import { Button } from '@mantine/core';
import type { StudyTemplate } from '@/client/schema.gen';
import classes from './builder.module.css';

interface Props {
  templates: readonly StudyTemplate[];
  onChoose: (template: StudyTemplate) => void;
}

export function Templates({ templates, onChoose }: Props) {
  return (
    <fieldset className={classes.set}>
      <legend className={classes.legend}>Begin with</legend>
      <div className={classes.chips}>
        {templates.map((template) => (
          <Button
            key={template.name}
            variant="default"
            size="xs"
            title={template.summary}
            onClick={() => onChoose(template)}
          >
            {template.title}
          </Button>
        ))}
      </div>
      <p className="faint">Each fills the form below; nothing is queued before you launch.</p>
    </fieldset>
  );
}
